// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "cairn/core/bit_cast.h"
#include "cairn/core/export.h"

namespace cairn {

/// FNV-1a over the bit patterns it is fed, for comparing states of two runs. Not for security.
class CAIRN_CORE_EXPORT StateHash {
 public:
  /// Feeds eight bytes, the lowest first.
  void add(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) value_ = (value_ ^ ((bits >> (8 * i)) & 0xFFU)) * 1099511628211ULL;
  }
  /// Feeds bytes in their order.
  void add(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) value_ = (value_ ^ std::to_integer<std::uint64_t>(b)) * 1099511628211ULL;
  }
  /// Feeds the bits of a number.
  void add(float v) { add(static_cast<std::uint64_t>(bitCast<std::uint32_t>(v))); }
  /// Feeds the bits of a number.
  void add(double v) { add(bitCast<std::uint64_t>(v)); }

  /// The hash of all that was fed.
  std::uint64_t value() const { return value_; }
  /// Sixteen hexadecimal digits.
  std::string hex() const;

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace cairn
