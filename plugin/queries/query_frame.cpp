// SPDX-License-Identifier: Zlib
#include "queries/query_frame.h"

#include <limits>

namespace cairn::bullet {

namespace {

// A few products and sums of three coordinates each: transforms, a plane's distance, an interpolation.
constexpr double kRoundings = 8;

}  // namespace

double roundingSlack(const SphereTreeShape& shape, double farthest) {
  const auto reach = double(shape.tree().reach());
  return kRoundings * ((farthest / double(shape.scale()) + reach) * double(SIMD_EPSILON) +
                       reach * double(std::numeric_limits<float>::epsilon()));
}

}  // namespace cairn::bullet
