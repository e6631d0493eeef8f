// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cairn::rockfall {

/// SHA-256 of a list of pieces. The length of each piece precedes it, so different lists never give the same bytes.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  /// Returns 64 hexadecimal digits. `add` must not be called afterwards.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cairn::rockfall
