// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>

#include "contacts/contact.h"
#include "contacts/relative_placement.h"

namespace cairn::bullet {

/// The motion of the two bodies of a pair: pair frame, velocities per second. It decides bounces and speculative
/// contacts.
struct RelativeMotion {
  Vec3 treeLinear, treeAngular, treeCenter;
  Vec3 otherLinear, otherAngular, otherCenter;
  RelativePlacement placement;
  float timeStep = 0;       ///< seconds
  float smallerSize = 0;    ///< of the smaller body, world length
  float maxSeparation = 0;  ///< contacts with a separation below this are wanted, world length
  float reported = 0;       ///< contacts beyond this are wanted only where the surfaces meet soon, world length

  /// Bound on the relative speed of all points within half the smaller body's size of a common centre.
  float greatestSpeed() const {
    return length(treeLinear - otherLinear) + 0.5F * smallerSize * length(treeAngular - otherAngular);
  }

  /// Whether no point moves farther in a step than a tenth of `reported`: bodies that rest or creep.
  bool isSlow() const { return greatestSpeed() * timeStep < 0.1F * reported; }

  /// Speed at which the surfaces approach each other at a contact; negative when they separate.
  float closingSpeed(const Contact& c) const {
    const Vec3 tree = treeLinear + cross(treeAngular, (c.isSpeculative ? c.onTree() : c.position) - treeCenter);
    const Vec3 other = otherLinear + cross(otherAngular, (c.isSpeculative ? c.onCollider() : c.position) - otherCenter);
    return dot(c.normal, other - tree);
  }

  /// Part of a gap that surfaces must close in a step to meet soon. The rest is for what the solver adds. Without it
  /// facing walls take a rim's places (`ThinWall.StopsALidOnTheRimOfItsJar`).
  static constexpr float kClosedPart = 0.5F;
  bool meetsSoon(const Contact& c) const { return closingSpeed(c) * timeStep >= kClosedPart * c.separation; }

  /// World length to add to a contact's separation for the solver, because a surface that rotates moves away from its
  /// tangent. A point of a rotating body moves on an arc, and the solver moves it straight.
  ///
  /// The height of the arc is half the step squared, times the acceleration along the normal. Added once, it makes the
  /// separation at the end of the step right to second order. It is added three times: contacts that close only within
  /// the step then carry no load at its beginning, where they would brake. At most the approach due to rotation alone,
  /// and at most `reported`; 0 where rotation separates the surfaces. See docs/algorithms/leaf-contacts.md.
  float curvatureCorrection(const Contact& c) const {
    const Vec3 tree = cross(treeAngular, c.position - treeCenter);
    const Vec3 other = cross(otherAngular, c.position - otherCenter);
    const float nearer = timeStep * dot(c.normal, other - tree);
    const float arc =
        3 * 0.5F * timeStep * timeStep * dot(c.normal, cross(treeAngular, tree) - cross(otherAngular, other));
    return std::clamp(arc, 0.0F, std::clamp(nearer, 0.0F, reported));
  }
};

}  // namespace cairn::bullet
