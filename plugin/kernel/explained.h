// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <span>

#include "kernel/contact_tuning.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// How far a point of A, or of B, is behind the surface that the contact knows. Pair frame, world length.
inline float depthUnder(const FeatureContact& contact, const Vec3& point, bool isOfA) {
  const float height = dot(contact.normal, point - contact.position);
  return (isOfA ? -height : height) - 0.5F * contact.separation;
}

inline bool isIn(const Box& box, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < box.lower[axis] || p[axis] > box.upper[axis]) return false;
  return true;
}

/// Whether a point of one body inside the other is there because of what a contact tells, which need not be repeated.
inline bool isExplained(std::span<const FeatureContact> contacts, const Vec3& point, bool isOfA,
                        const ContactLimits& limits) {
  const float slack = tuning::kExplainedSlack * limits.contactDistance;
  return std::ranges::any_of(contacts, [&](const FeatureContact& c) {
    const float depth = depthUnder(c, point, isOfA);
    return !isDeep(c.kind) && depth >= -slack &&
           depth <= tuning::kExplainedDepths * std::max(-c.separation, 0.0F) + slack;
  });
}

}  // namespace cairn::bullet
