// SPDX-License-Identifier: Zlib
#pragma once

#include "continuous/trajectory.h"

namespace cairn::bullet {

/// The relative pose of two bodies, in the frame of a sweep, world unit.
struct SweptPlace {
  btTransform tree;       ///< of the tree's shape, in the frame
  btMatrix3x3 otherAxes;  ///< the other body's axes, in the frame; its origin is the frame's
};

/// Interpolates straight and along the shortest rotation between two poses of one frame: part 0 is `x`, part 1 is `y`.
SweptPlace placeBetween(const SweptPlace& x, const SweptPlace& y, btScalar part);
/// The rotation of both bodies together, in radians.
btScalar turnBetween(const SweptPlace& x, const SweptPlace& y);

/// The frame of a sweep is the other body's own. If the other is the smaller body, the frame is at its place, with the
/// world's axes. In the frame of a rolling wheel, all things beside it would move on arcs, and its ground would tilt.
///
///     const SweptFrame frame(treeTrajectory, otherTrajectory, keepsAxes);
///     const SweptPlace place = frame.at(0.5F);
class SweptFrame {
 public:
  /// `keepsAxes`: the other is the smaller one.
  SweptFrame(const Trajectory& tree, const Trajectory& other, bool keepsAxes)
      : tree_(tree), other_(other), keepsAxes_(keepsAxes) {}

  /// The relative pose after this fraction of the step, 0 to 1, if nothing stops the bodies.
  SweptPlace at(btScalar part) const;
  /// The frame at the beginning of the step, in the world.
  btTransform inWorld() const;

 private:
  Trajectory tree_, other_;
  bool keepsAxes_;
};

}  // namespace cairn::bullet
