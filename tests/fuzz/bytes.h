// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn::fuzz {

/// Hands out an input's bytes one by one, zeros after its end: every input means something. Ask in statements of their
/// own or in braces: in which order a call's arguments and an operator's sides are evaluated, each compiler chooses.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t next() { return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0}; }
  /// 0 to `count` - 1. Precondition: 0 < `count` < 65536.
  std::uint32_t below(std::uint32_t count) {
    const std::uint32_t high = next();
    return (high << 8 | next()) % count;
  }
  /// 0 to 1, both among them.
  double part() { return double(next()) / 255; }
  double between(double low, double high) { return low + (high - low) * part(); }
  /// A power of ten with an exponent of -`most` to `most`: 1 for a byte of zero.
  double powerOfTen(int most) {
    const int exponent = int(next()) % (2 * most + 1);
    return std::pow(10.0, exponent <= most ? exponent : most - exponent);
  }
  bool done() const { return at_ >= bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace cairn::fuzz
