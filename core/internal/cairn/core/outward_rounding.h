// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <limits>

namespace cairn {

/// The least float that is no less than a number: a proved upper bound stays one.
inline float roundUp(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// The greatest float that is no more than a number: a proved lower bound stays one.
inline float roundDown(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

}  // namespace cairn
