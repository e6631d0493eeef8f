// SPDX-License-Identifier: Zlib
#include "cairn/core/perceptual.h"

#include <cmath>

namespace cairn {

namespace {
double momentumOf(const ScheduledPair& pair) {
  return static_cast<double>(pair.mass) * static_cast<double>(pair.closingSpeed);
}
}  // namespace

void Perceptual::beginWeights(std::span<const ScheduledPair> pairs) {
  double sum = 0, count = 0;
  for (const ScheduledPair& pair : pairs) {
    if (pair.traversal->done() || !std::isfinite(momentumOf(pair))) continue;
    sum += momentumOf(pair);
    count += 1;
  }
  meanMomentum_ = count > 0 ? sum / count : 0;
}

double Perceptual::momentumFactor(const ScheduledPair& pair) const {
  const double momentum = momentumOf(pair);
  return meanMomentum_ > 0 ? 0.5 + momentum / (momentum + meanMomentum_) : 1;
}

double Perceptual::weight(const ScheduledPair& pair) const {
  if (!viewer_) return momentumFactor(pair);
  const Sight sight = sightOf(*viewer_, pair.center, static_cast<double>(pair.size) / 2);
  const double visibility = sight.isVisible ? 1 : kOutOfView;
  return visibility * acuityAt(sight.eccentricity) / sight.distance * momentumFactor(pair);
}

}  // namespace cairn
