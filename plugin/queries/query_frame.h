// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "cairn/bullet/sphere_tree_shape.h"
#include "queries/segment.h"
#include "queries/swept_box.h"

namespace cairn::bullet {

/// The moving body of a sweep, as a box about its origin that holds it all the way. The box has the axes of the query's
/// frame, and the world's unit. It is grown by the distance at which Bullet ends a cast.
struct Mover {
  btVector3 center, halfExtent;
};
/// The callback's moving body. `worldFromFrame`: maps the query's frame to the world.
Mover moverOf(const btTriangleConvexcastCallback& callback, const btTransform& worldFromFrame);

/// A point of the body's frame in the tree's frame and unit.
Vec3d pointInTree(const SphereTreeShape& shape, const btVector3& point);

/// Products and sums of three coordinates in which Bullet's triangle tests and our node tests can differ: transforms, a
/// plane's distance, an interpolation.
inline constexpr double kQueryRoundings = 8;

/// Bound, in the tree's unit, on the rounding difference between Bullet's triangle tests and our node tests.
/// `farthest`: the largest coordinate involved, in the world's unit.
double roundingSlack(const SphereTreeShape& shape, double farthest);

/// How far outside a triangle, in the tree's unit, Bullet may report a hit of a ray. It allows 1e-4 in each barycentric
/// coordinate, which moves a point by at most twice that times the longest edge.
double edgeTolerance(const SphereTreeShape& shape);

/// The ray (body's frame) in the tree's frame and unit. `slack`, in the tree's unit, grows nodes in addition to
/// rounding.
Segment segmentOf(const SphereTreeShape& shape, const btTriangleRaycastCallback& ray, double slack);

/// The moving body (world frame) as a box in the tree's frame and unit that holds it all the way. It is grown by the
/// distance at which Bullet ends a cast, by rounding and by `margin` (the world's unit).
SweptBox sweptBox(const SphereTreeShape& shape, const btTriangleConvexcastCallback& callback, btScalar margin);

}  // namespace cairn::bullet
