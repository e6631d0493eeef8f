// SPDX-License-Identifier: Zlib
#include "cairn/core/two_classes.h"

namespace cairn {

bool TwoClasses::isHigh(const ScheduledPair& pair) const {
  const auto size = static_cast<double>(pair.size);
  if (!viewer_) return static_cast<double>(pair.closingSpeed) > kHighRate * size;
  const Sight sight = sightOf(*viewer_, pair.center, size / 2);
  return sight.isVisible && sight.eccentricity <= kHighEccentricity;
}

double TwoClasses::weight(const ScheduledPair& pair) const {
  return isHigh(pair) ? 1 : kLowWeight;
}

}  // namespace cairn
