// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btTransform.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/core/sphere_tree.h"

namespace cairn::scenes {

/// A mesh ready for simulation in any shape. Every shape gets the same size, mass frame and inertia, taken from the
/// tree. Body frame: origin at the mesh's centre of mass, axes along its principal axes, metres.
///
///     Model model = makeModel(tree, 1.0); // 1 m across
struct Model {
  std::shared_ptr<const SphereTree> tree;
  double scale = 1;  ///< metres per mesh unit
  double size = 1;   ///< diagonal of the mesh's bounding box (mesh axes), metres
  double reach = 0;  ///< distance from the centre of mass to the farthest vertex, metres
  std::vector<Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  btVector3 inertia;  ///< principal moments of 1 kg

  /// Converts a point from the tree frame to the body frame.
  Vec3d bodyFromTree(const Vec3& p) const;
};

/// Returns the tree's mesh, scaled to a bounding-box diagonal of `size` metres (> 0).
Model makeModel(std::shared_ptr<const SphereTree> tree, double size);

/// Converts to Bullet's vector in its configured precision, and back.
inline btVector3 toBullet(const Vec3d& v) {
  return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}
inline Vec3d fromBullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace cairn::scenes
