// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btTransform.h>

#include <vector>

#include "scenes/bodies/model.h"
#include "scenes/truth/exact_check.h"

namespace cairn::scenes {

/// An axis-parallel box, world frame, metres.
struct Box {
  Vec3d lower, upper;

  bool overlaps(const Box& o) const;
};

/// A body of a model where a scene has put it, as the exact check sees it.
struct PlacedBody {
  Placement worldFromBody;
  std::vector<Vec3d> vertices;  ///< world frame
  Box box;                      ///< of the vertices
};

/// Bullet's pose in double precision, its rotation made orthonormal again: the check must not see single precision's
/// stretch.
Placement placementOf(const btTransform& pose);

PlacedBody placeBody(const btTransform& pose, const Model& model);

/// How body `a` stands in the frame of body `b`.
inline Placement relativePlacement(const Placement& worldFromA, const Placement& worldFromB) {
  return worldFromB.inverse() * worldFromA;
}

}  // namespace cairn::scenes
