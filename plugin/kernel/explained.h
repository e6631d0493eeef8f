// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <span>

#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// Depth of a point of A, or of B, behind the contact's plane. Pair frame, world length.
inline float depthUnder(const FeatureContact& contact, const Vec3& point, bool isOfA) {
  const float height = dot(contact.normal, point - contact.position);
  return (isOfA ? -height : height) - 0.5F * contact.separation;
}

/// Whether some local minimum of surfaces in contact has the point behind its plane. The point may be as deep as
/// `most(contact)`, and hardly in front. The reach of a query does not matter.
template <class Most>
bool isUnderAny(std::span<const FeatureContact> contacts, const Vec3& point, bool isOfA, const ContactLimits& limits,
                const Most& most) {
  return std::ranges::any_of(contacts, [&](const FeatureContact& c) {
    const float depth = depthUnder(c, point, isOfA);
    return !isDeep(c.kind) && c.separation <= limits.contactDistance &&
           depth >= -tuning::kExplainedSlack * limits.contactDistance && depth <= most(c);
  });
}

/// Whether a contact already accounts for a point of one body inside the other, so that the point needs no contact of
/// its own. A point deeper than any local minimum is never explained.
inline bool isExplained(std::span<const FeatureContact> contacts, const Vec3& point, bool isOfA,
                        const ContactLimits& limits) {
  return isUnderAny(contacts, point, isOfA, limits, [&](const FeatureContact& c) {
    const float depth =
        std::clamp(-tuning::kExplainedDepths * c.separation, 0.0F, limits.trustedDepth + limits.margins);
    return depth + tuning::kExplainedSlack * limits.contactDistance;
  });
}

}  // namespace cairn::bullet
