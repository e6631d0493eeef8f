// SPDX-License-Identifier: Zlib
#include "pairs/speculative_contacts.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

// Normals more than 120 degrees apart resist opposite motions.
constexpr float kOpposedCosine = 0.5F;

// Along another direction: the overlap exceeds the way back by which it passed the speculative contact.
bool isLongerWayOut(const Contact& now, const Contact& speculative) {
  const float passed = speculative.distance();
  return passed < 0 && now.separation < passed && dot(now.normal, speculative.normal) < kSameNormalCosine;
}

bool isOpposed(const Contact& now, const Contact& speculative) {
  return dot(now.normal, speculative.normal) < -kOpposedCosine;
}

}  // namespace

// A body that runs into something, or has passed it, is held on the side it came from. Contacts on the other side mean
// nothing, and neither do those that would push it out by a longer way. Leaves as wide as the body, and far wider than
// a slab, overlap along their lines of centres by half the body: without this rule it was thrown along the slab and out
// below.
void dropOverruled(std::span<const Contact> speculative, float maxSeparation, ClusteredContacts& contacts) {
  if (speculative.empty()) return;
  for (int k = 0; k < kMaxClusters; ++k) {
    for (Contact& c : contacts.cluster(k)) {
      const auto overrules = [&](const Contact& one) { return isOpposed(c, one) || isLongerWayOut(c, one); };
      if (!c.isSpeculative && std::ranges::any_of(speculative, overrules)) c.separation = maxSeparation;
    }
    contacts.resort(k, maxSeparation);
  }
}

}  // namespace cairn::bullet
