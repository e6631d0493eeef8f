// SPDX-License-Identifier: Zlib
#pragma once

#include "contacts/contact.h"
#include "contacts/relative_placement.h"

namespace cairn::bullet {

/// How the two bodies of a pair move, pair frame, per second.
struct RelativeMotion {
  Vec3 treeLinear, treeAngular, treeCenter;
  Vec3 otherLinear, otherAngular, otherCenter;
  RelativePlacement placement;
  float timeStep = 0;     ///< seconds
  float smallerSize = 0;  ///< of the smaller body, world length
  float reach = 0;        ///< contacts with a gap below this are wanted

  /// No point within half the smaller body's size of a common centre moves faster against the other body.
  float greatestSpeed() const {
    return length(treeLinear - otherLinear) + 0.5F * smallerSize * length(treeAngular - otherAngular);
  }

  /// Speed at which the surfaces approach each other at a contact; negative when they part.
  float closingSpeed(const Contact& c) const {
    const Vec3 tree = treeLinear + cross(treeAngular, c.position - treeCenter);
    const Vec3 other = otherLinear + cross(otherAngular, c.position - otherCenter);
    return dot(c.normal, other - tree);
  }
};

}  // namespace cairn::bullet
