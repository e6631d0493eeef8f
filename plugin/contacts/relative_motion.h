// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

#include "contacts/contact.h"
#include "contacts/relative_placement.h"

namespace cairn::bullet {

/// How the two bodies of a pair move, pair frame, per second.
struct RelativeMotion {
  Vec3 treeLinear, treeAngular, treeCenter;
  Vec3 otherLinear, otherAngular, otherCenter;
  RelativePlacement placement;
  float timeStep = 0;       ///< seconds
  float smallerSize = 0;    ///< of the smaller body, world length
  float maxSeparation = 0;  ///< contacts with a gap below this are wanted

  /// No point within half the smaller body's size of a common centre moves faster against the other body.
  float greatestSpeed() const {
    return length(treeLinear - otherLinear) + 0.5F * smallerSize * length(treeAngular - otherAngular);
  }

  /// Whether within a step nothing moves farther than a tenth of what contacts reach: bodies that rest, or creep.
  bool isSlow() const { return greatestSpeed() * timeStep < 0.1F * maxSeparation; }

  /// Speed at which the surfaces approach each other at a contact; negative when they part.
  float closingSpeed(const Contact& c) const {
    const Vec3 tree = treeLinear + cross(treeAngular, (c.isSpeculative ? c.onTree() : c.position) - treeCenter);
    const Vec3 other = otherLinear + cross(otherAngular, (c.isSpeculative ? c.onCollider() : c.position) - otherCenter);
    return dot(c.normal, other - tree);
  }

  /// World length by which the solver is told that the surfaces at a contact are farther apart than they are, because
  /// what turns bends away: a point of a turning body moves on an arc, and the solver moves it straight on. Once the
  /// arc's height (half the step squared times the acceleration along the normal) makes the gap at the end of the step
  /// right to second order; taken three times, what only comes down within the step does not carry at its beginning,
  /// while it is still ahead and would brake. At most the way that turning alone brings the surfaces nearer, and the
  /// reach; 0 where turning parts them. See docs/algorithms/leaf-contacts.md.
  float curvatureCorrection(const Contact& c) const {
    const Vec3 tree = cross(treeAngular, c.position - treeCenter);
    const Vec3 other = cross(otherAngular, c.position - otherCenter);
    const float nearer = timeStep * dot(c.normal, other - tree);
    const float arc =
        3 * 0.5F * timeStep * timeStep * dot(c.normal, cross(treeAngular, tree) - cross(otherAngular, other));
    return std::clamp(arc, 0.0F, std::clamp(nearer, 0.0F, maxSeparation));
  }
};

}  // namespace cairn::bullet
