// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/robot.h"
#include "robot/surface_contact.h"

namespace cairn::builder {

/// A link as a planner sees it: its spheres, and boxes and cylinders that are kept. Link's frame. Immutable.
class LinkSpheres {
 public:
  LinkSpheres(const RobotLink& link, const std::vector<RobotPart>& parts);

  bool empty() const { return balls_.empty() && shapes_.empty(); }
  /// Whether two links touch. `pose` leads from the other's frame into this one's. Errs towards touching, by rounding
  /// alone; two kept shapes touch where their surfaces meet.
  bool touches(const LinkSpheres& other, const RigidPose& pose) const;

 private:
  bool touchesShapes(const LinkSpheres& other, const RigidPose& pose, double slack) const;

  std::vector<Ball> balls_;
  std::vector<CollisionShape> shapes_;  // boxes and cylinders
  LinkSurface shapeSurface_;
  Ball bound_;  // around the balls
};

}  // namespace cairn::builder
