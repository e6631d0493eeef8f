// SPDX-License-Identifier: Zlib AND MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cairn/core/bit_cast.h"

namespace cairn::bullet::platform {

/// Sine and cosine in single precision with the bits that the GNU C library gives, on every platform. Bullet turns
/// bodies by both, and C libraries differ in the last bit: musl's (Emscripten) in 3 of 1000 sines.
///
/// Method, numbers and the table of 4/pi: Arm Optimized Routines, sincosf.h, Copyright (c) 2018, Arm Limited, MIT
/// License. The GNU C library 2.28 and later has the same. Of all floats, 12 sines and 22 cosines differ from that
/// library's on a processor with fused products. Error: 0.56 units in the last place.

/// A remainder between -pi/4 and pi/4, and how many quarter turns were taken away.
struct Reduced {
  double angle;
  int quarters;
};

/// By one product: for angles below 120 radians.
inline Reduced reducedFast(double angle) {
  constexpr double kQuartersPerRadian = 0x1.45F306DC9C883p+23;  // times 2^24, so that the quarter is in the upper bits
  constexpr double kQuarter = 0x1.921FB54442D18p0;
  const int quarters = (static_cast<std::int32_t>(angle * kQuartersPerRadian) + 0x800000) >> 24;
  return {angle - quarters * kQuarter, quarters};
}

/// By 96 bits of 4/pi, without the sign: for all finite angles from 2 on.
inline Reduced reducedExactly(std::uint32_t bits) {
  constexpr std::array<std::uint32_t, 24> kInversePi = {
      0xa2,       0xa2f9,     0xa2f983,   0xa2f9836e, 0xf9836e4e, 0x836e4e44, 0x6e4e4415, 0x4e441529,
      0x441529fc, 0x1529fc27, 0x29fc2757, 0xfc2757d1, 0x2757d1f5, 0x57d1f534, 0xd1f534dd, 0xf534ddc0,
      0x34ddc0db, 0xddc0db62, 0xc0db6295, 0xdb629599, 0x6295993c, 0x95993c43, 0x993c4390, 0x3c439041};
  const std::size_t first = bits >> 26 & 15;
  const std::uint32_t mantissa = ((bits & 0xffffff) | 0x800000) << (bits >> 23 & 7);
  const std::uint64_t low = std::uint64_t{mantissa} * kInversePi[first + 8];
  std::uint64_t turns = (low >> 32) | std::uint64_t{mantissa * kInversePi[first]} << 32;
  turns += std::uint64_t{mantissa} * kInversePi[first + 4];
  const std::uint64_t quarters = (turns + (std::uint64_t{1} << 61)) >> 62;
  turns -= quarters << 62;
  return {static_cast<double>(static_cast<std::int64_t>(turns)) * 0x1.921FB54442D18p-62, static_cast<int>(quarters)};
}

/// Sine of -pi/4 to pi/4.
inline double nearSine(double x, double square) {
  const double cube = x * square;
  const double tail = 0x1.1107605230bc4p-7 + square * -0x1.994eb3774cf24p-13;
  return x + cube * -0x1.555545995a603p-3 + cube * square * tail;
}

/// Cosine of the same.
inline double nearCosine(double square) {
  const double fourth = square * square;
  const double tail = -0x1.6c087e89a359dp-10 + square * 0x1.99343027bf8c3p-16;
  const double head = 1.0 + square * -0x1.ffffffd0c621cp-2 + fourth * 0x1.55553e1068f19p-5;
  return head + fourth * square * tail;
}

/// Sine of an angle plus so many quarter turns. Not finite: not a number.
inline float sineFrom(float angle, int quarters) {
  const auto bits = bitCast<std::uint32_t>(angle);
  const std::uint32_t top = bits >> 20 & 0x7ff;  // of the size, enough to choose the way
  // The upper twelve bits, without the sign, of pi / 4, of 2^-12, of 120 radians and of infinity.
  constexpr std::uint32_t kEighth = 0x3f4, kTiny = 0x398, kLarge = 0x42f, kInfinite = 0x7f8;
  if (top >= kInfinite) return std::numeric_limits<float>::quiet_NaN();
  Reduced reduced{double(angle), 0};
  if (top < kTiny) return quarters % 2 == 0 ? angle : 1.0F;
  if (top >= kLarge) {
    reduced = reducedExactly(bits);
    if (bits >> 31 != 0) reduced = {-reduced.angle, -reduced.quarters};
  } else if (top >= kEighth) {
    reduced = reducedFast(double(angle));
  }
  const int turned = (reduced.quarters + quarters) & 3;
  const double square = reduced.angle * reduced.angle;
  const double size = turned % 2 == 0 ? nearSine(reduced.angle, square) : nearCosine(square);
  return static_cast<float>(turned < 2 ? size : -size);
}

/// Sine of an angle in radians.
inline float sine(float angle) {
  return sineFrom(angle, 0);
}

/// Cosine of an angle in radians.
inline float cosine(float angle) {
  return sineFrom(angle, 1);
}

}  // namespace cairn::bullet::platform
