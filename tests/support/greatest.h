// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <limits>

namespace cairn::test {

/// The greater of two figures, or no number where either is none, which `std::max` would drop.
inline double greatest(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::quiet_NaN();
  return a < b ? b : a;
}

}  // namespace cairn::test
