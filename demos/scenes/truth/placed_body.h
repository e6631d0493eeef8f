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

/// A body of a model at its place in a scene, for the exact check.
struct PlacedBody {
  Placement worldFromBody;
  std::vector<Vec3d> vertices;  ///< world frame
  Box box;                      ///< of the vertices
};

/// Returns Bullet's pose in double precision with an orthonormal rotation, because single precision stretches the
/// rotation slightly.
Placement placementOf(const btTransform& pose);

PlacedBody placeBody(const btTransform& pose, const Model& model);

/// Returns the pose of body `a` in the frame of body `b`.
inline Placement relativePlacement(const Placement& worldFromA, const Placement& worldFromB) {
  return worldFromB.inverse() * worldFromA;
}

}  // namespace cairn::scenes
