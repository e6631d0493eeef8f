// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <vector>

#include "kernel/contact_limits.h"
#include "kernel/contact_tuning.h"
#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// Where several features stop the same overlap the shallowest says the way out, if it is one: what stands in a corner
/// is still below the floor when it has come out of the wall. `staysInside(contact, other)`: whether what the contact
/// says to be inside the other body still is once A has moved out along `other`. `kept`: working memory.
template <class StaysInside>
void dropDeeper(std::vector<FeatureContact>& contacts, std::vector<FeatureContact>& kept, const ContactLimits& limits,
                const StaysInside& staysInside) {
  const auto isOverruled = [&](const FeatureContact& c) {
    if (c.separation + limits.margins >= 0) return false;
    const float near = -tuning::kNearDepths * c.separation + tuning::kNearDistances * limits.contactDistance;
    return std::ranges::any_of(contacts, [&](const FeatureContact& o) {
      return o.separation > tuning::kShallower * c.separation && dot(o.normal, c.normal) < tuning::kOtherWayCosine &&
             lengthSq(o.position - c.position) <= near * near && !staysInside(c, o);
    });
  };
  kept.clear();
  for (const FeatureContact& contact : contacts)
    if (!isOverruled(contact)) kept.push_back(contact);
  contacts.swap(kept);
}

}  // namespace cairn::bullet
