// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "bytes.h"
#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::fuzz {

/// A shape, and what may be asked of its body.
struct MadeShape {
  std::shared_ptr<btCollisionShape> shape;
  bullet::SphereTreeShape* tree = nullptr;  ///< the shape itself, where it is a tree and no part of a compound
  bool hasTree = false;
  bool isFixed = false;  ///< for bodies that do not move
  bool isHonest = true;  ///< its tree's balls and errors hold
};

/// A power of ten of an exponent of -`mostPowerOfTen` to that, once or up to twice.
double scaleFrom(Bytes& bytes, int mostPowerOfTen);

/// A tree of a solid, also scaled, with a margin, in either frame; of those asked for, sometimes a damaged one.
MadeShape treeShapeFrom(Bytes& bytes, int mostPowerOfTen, bool mayBeDamaged);

/// That, or anything of Bullet's that a tree can meet: convex shapes (flat ones and points among them), a plane,
/// triangles (some without area) as any of Bullet's meshes, height fields, a terrain, a distance field, compounds.
MadeShape shapeFrom(Bytes& bytes, int mostPowerOfTen, bool mayBeDamaged);

}  // namespace cairn::fuzz
