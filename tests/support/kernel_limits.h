// SPDX-License-Identifier: Zlib
#pragma once

#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"

namespace cairn::test {

/// Limits of the contact kernel for bodies about a metre across, as the plugin derives them from sizes.
inline bullet::ContactLimits limitsOf(float skin = 0) {
  constexpr float kSize = 0.9F;
  bullet::ContactLimits limits;
  limits.contactDistance = limits.maxSeparation = bullet::tuning::kContactDistance * kSize;
  limits.trustedDepth = bullet::tuning::kTrustedDepth * kSize;
  limits.thickness = kSize;
  limits.skin = skin;
  limits.size = kSize;
  return limits;
}

}  // namespace cairn::test
