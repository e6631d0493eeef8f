// SPDX-License-Identifier: Zlib
#include "kernel/contact_limits.h"

#include <algorithm>

#include "kernel/contact_tuning.h"

namespace cairn::bullet {

ContactLimits ContactLimits::of(float contactDistance, float maxSeparation, float thickness, float margins) {
  const float size = contactDistance / tuning::kContactDistance;
  const float trusted = std::min(tuning::kTrustedDepth * size, tuning::kTrustedThickness * thickness);
  return {contactDistance, maxSeparation, trusted, thickness, margins, 0, size};
}

float ContactLimits::besideAt(float separation) const {
  const float depth = separation < 0 ? std::min(-separation, contactDistance) : 0;
  return std::max(tuning::kBeside * contactDistance, depth);
}

float ContactLimits::belowAt(float separation, float neighbourDistance) const {
  const float depth = std::max({overlap - contactDistance, -separation, 0.0F});
  return contactDistance + std::min(depth, tuning::kConeOpening * neighbourDistance);
}

}  // namespace cairn::bullet
