// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/segment.h"
#include "queries/swept_box.h"

namespace cairn::bullet {

/// What moves in a sweep: a box that holds it all the way, about its origin, with the axes of the frame it is seen from
/// and in the world's unit; grown by the distance at which Bullet ends a cast.
struct Mover {
  btVector3 center, halfExtent;
};
Mover moverOf(const btTriangleConvexcastCallback& callback, const btTransform& worldFromFrame);

/// A point of the body's frame in the tree's frame and unit.
Vec3d pointInTree(const SphereTreeShape& shape, const btVector3& point);

/// Products and sums of three coordinates by which Bullet's tests of triangles and our own of what holds them can
/// differ: transforms, a plane's distance, an interpolation.
inline constexpr double kQueryRoundings = 8;

/// By how much, in the tree's unit, Bullet's tests of triangles and our own of nodes can differ by rounding alone.
/// `farthest`: the largest coordinate that takes part, in the world's unit.
double roundingSlack(const SphereTreeShape& shape, double farthest);

/// How far outside a triangle, in the tree's unit, Bullet may say that a ray hits it: 1e-4 in each barycentric
/// coordinate, which moves a point by at most twice that times the longest edge.
double edgeTolerance(const SphereTreeShape& shape);

/// The ray (body's frame) in the tree's frame and unit. `slack`, in that unit, is what nodes are to be grown by besides
/// rounding.
Segment segmentOf(const SphereTreeShape& shape, const btTriangleRaycastCallback& ray, double slack);

/// What moves (the world's frame) in the tree's frame and unit: a box that holds it all the way, grown by the distance
/// at which Bullet ends a cast, by rounding and by `margin` (the world's unit).
SweptBox sweptBox(const SphereTreeShape& shape, const btTriangleConvexcastCallback& callback, btScalar margin);

}  // namespace cairn::bullet
