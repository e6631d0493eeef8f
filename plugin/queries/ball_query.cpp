// SPDX-License-Identifier: Zlib
#include "queries/ball_query.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>

#include "placement/bullet_math.h"
#include "queries/leaf_walk.h"
#include "queries/query_frame.h"

namespace cairn::bullet {

namespace {

// A leaf's ball in its body's frame.
struct Ball {
  Ball(const SphereTreeShape& shape, NodeId leaf) {
    const Sphere s = shape.tree().sphere(leaf);
    center = shape.bodyFromTree() * (toBullet(s.center) * shape.scale());
    radius = btScalar(s.radius) * shape.scale() + shape.getMargin();
  }

  btVector3 center;
  btScalar radius;
};

// The fraction at which a path enters the ball; 1 or more if it does not. Computed from the path's point nearest to the
// centre, so that a distant ball is hit as exactly as a near one.
double entryInto(const Ball& ball, const Vec3d& from, const Vec3d& to) {
  constexpr double kNever = 2;
  const Vec3d displacement = to - from, toCenter = toVec3d(ball.center) - from;
  const auto radius = double(ball.radius);
  if (lengthSq(toCenter) <= radius * radius) return kNever;
  const double displacementSq = lengthSq(displacement), nearest = dot(toCenter, displacement) / displacementSq;
  const double halfSq = (radius * radius - lengthSq(toCenter - displacement * nearest)) / displacementSq;
  if (!(halfSq >= 0)) return kNever;
  const double entry = nearest - std::sqrt(halfSq);
  return entry >= 0 ? entry : kNever;
}

void castAt(const Ball& ball, int level, NodeId leaf, btTriangleConvexcastCallback& callback, btScalar& limit) {
  btSphereShape sphere(ball.radius);
  btVoronoiSimplexSolver simplexSolver;
  btGjkEpaPenetrationDepthSolver depthSolver;
  btContinuousConvexCollision caster(callback.m_convexShape, &sphere, &simplexSolver, &depthSolver);
  btConvexCast::CastResult cast;
  cast.m_fraction = 1;
  cast.m_allowedPenetration = callback.m_allowedPenetration;
  const btTransform at = callback.m_triangleToWorld * btTransform(btMatrix3x3::getIdentity(), ball.center);
  if (!caster.calcTimeOfImpact(callback.m_convexShapeFrom, callback.m_convexShapeTo, at, at, cast)) return;
  if (!(cast.m_normal.length2() > btScalar(0.0001)) || !(cast.m_fraction < limit)) return;
  const btScalar answer =
      callback.reportHit(cast.m_normal.normalized(), cast.m_hitPoint, cast.m_fraction, level, static_cast<int>(leaf));
  if (answer == cast.m_fraction) limit = std::min(limit, answer);
}

}  // namespace

void castRayAtBalls(const SphereTreeShape& shape, const LeafBalls& balls, btTriangleRaycastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const Segment segment = segmentOf(shape, callback, double(shape.getMargin()) / double(shape.scale()));
  if (!segment.isSane()) return;
  const Vec3d from = toVec3d(callback.m_from), to = toVec3d(callback.m_to);
  walkLeaves(
      tree,
      [&](std::uint32_t family, float end) {
        return entriesOf(segment, balls.family(family), tree.livingLanes(family), end);
      },
      [&] { return segment.placeOf(double(callback.m_hitFraction)); },
      [&](NodeId leaf) {
        const Ball ball(shape, leaf);
        const double fraction = entryInto(ball, from, to);
        if (!(fraction < double(callback.m_hitFraction))) return;
        const btVector3 normal = toBullet(normalized(from + (to - from) * fraction - toVec3d(ball.center)));
        callback.m_hitFraction =
            callback.reportHit(normal, btScalar(fraction), static_cast<int>(tree.level(leaf)), static_cast<int>(leaf));
      });
}

bool castConvexAtBalls(const SphereTreeShape& shape, const LeafBalls& balls, btTriangleConvexcastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const SweptBox box = sweptBox(shape, callback, shape.getMargin());
  if (!box.path().isSane()) return false;
  btScalar limit = callback.m_hitFraction;
  walkLeaves(
      tree,
      [&](std::uint32_t family, float end) {
        return box.entriesOf(balls.family(family), tree.livingLanes(family), end);
      },
      [&] { return box.path().placeOf(double(limit)); },
      [&](NodeId leaf) { castAt(Ball(shape, leaf), static_cast<int>(tree.level(leaf)), leaf, callback, limit); });
  return true;
}

}  // namespace cairn::bullet
