// SPDX-License-Identifier: Zlib
#pragma once

#include "continuous/trajectory.h"

namespace cairn::bullet {

/// How two bodies stand to each other in the frame a sweep is made in, world unit.
struct SweptPlace {
  btTransform tree;       ///< its shape's, in the frame
  btMatrix3x3 otherAxes;  ///< the other body's own, in the frame; its origin is the frame's
};

/// On the straight and shortest way between two, both of one frame: part 0 is `x`, part 1 is `y`.
SweptPlace placeBetween(const SweptPlace& x, const SweptPlace& y, btScalar part);
/// Radians, of both bodies together.
btScalar turnBetween(const SweptPlace& x, const SweptPlace& y);

/// The frame of the other body; or, if that is the smaller one, a frame at its place whose axes stay the world's: what
/// stands beside a wheel that rolls would else move on arcs about it, and its ground would tilt.
class SweptFrame {
 public:
  /// `keepsAxes`: the other is the smaller one.
  SweptFrame(const Trajectory& tree, const Trajectory& other, bool keepsAxes)
      : tree_(tree), other_(other), keepsAxes_(keepsAxes) {}

  /// How they stand after this part of the step, 0 to 1, if nothing stops them.
  SweptPlace at(btScalar part) const;
  /// The frame itself as the step begins, world frame.
  btTransform inWorld() const;

 private:
  Trajectory tree_, other_;
  bool keepsAxes_;
};

}  // namespace cairn::bullet
