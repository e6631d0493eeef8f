// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <vector>

#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// Where several features stop the same overlap, keeps the shallowest that is a way out. A body in a corner may be
/// below the floor even when it has come out of the wall: then both contacts stay. `staysInside(contact, other)`:
/// whether the contact's point is still inside the other body when A has moved out along `other`. `kept`: working
/// memory. Cost: quadratic in the contacts.
template <class StaysInside>
void dropDeeper(std::vector<FeatureContact>& contacts, std::vector<FeatureContact>& kept, const ContactLimits& limits,
                const StaysInside& staysInside) {
  const auto isOverruled = [&](const FeatureContact& c) {
    if (c.separation + limits.margins >= 0) return false;
    const float near = -tuning::kNearDepths * c.separation + tuning::kNearDistances * limits.contactDistance;
    return std::ranges::any_of(contacts, [&](const FeatureContact& o) {
      return o.separation > tuning::kShallower * c.separation &&
             dot(o.normal, c.normal) < tuning::kOtherDirectionCosine &&
             lengthSq(o.position - c.position) <= near * near && !staysInside(c, o);
    });
  };
  kept.clear();
  for (const FeatureContact& contact : contacts)
    if (!isOverruled(contact)) kept.push_back(contact);
  contacts.swap(kept);
}

}  // namespace cairn::bullet
