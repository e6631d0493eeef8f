// SPDX-License-Identifier: Zlib
#include "pairs/contacts_ahead.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

// Normals more than 120 degrees apart hold against opposite motions.
constexpr float kOpposedCosine = 0.5F;

// Along another direction, that what has passed the contact ahead is deeper in than it would have to go back.
bool isLongerWayOut(const Contact& now, const Contact& ahead) {
  const float passed = ahead.distance();
  return passed < 0 && now.gap < passed && dot(now.normal, ahead.normal) < kSameNormalCosine;
}

bool isOpposed(const Contact& now, const Contact& ahead) {
  return dot(now.normal, ahead.normal) < -kOpposedCosine;
}

}  // namespace

// What runs into something, or has passed it, is held on the side it came from: what touches on the other means
// nothing, nor does what would bring it out by a longer way. Leaves as wide as the body and far wider than the slab
// they are of overlap along the lines of centres by half the body: it was thrown along the slab, and out below.
void dropOverruled(std::span<const Contact> ahead, float reach, ClusteredContacts& contacts) {
  if (ahead.empty()) return;
  for (int k = 0; k < kMaxClusters; ++k) {
    for (Contact& c : contacts.cluster(k)) {
      const auto overrules = [&](const Contact& one) { return isOpposed(c, one) || isLongerWayOut(c, one); };
      if (!c.isAhead && std::ranges::any_of(ahead, overrules)) c.gap = reach;
    }
    contacts.resort(k, reach);
  }
}

}  // namespace cairn::bullet
