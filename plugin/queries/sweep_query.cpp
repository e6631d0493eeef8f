// SPDX-License-Identifier: Zlib
#include "queries/sweep_query.h"

#include <BulletCollision/CollisionShapes/btConvexShape.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "queries/leaf_walk.h"
#include "queries/query_frame.h"
#include "queries/seen_triangles.h"
#include "queries/swept_box.h"
#include "shape/placed_triangle.h"

namespace cairn::bullet {

namespace {

// Bullet's cast ends when the shapes are this close, in the world's unit.
constexpr double kContactRadius = 0.001;
// It reads the turn between two equal rotations off a quaternion's real part, which says 1 to within some roundings:
// their square root, as an angle.
const double kTurnNoise = 8 * std::sqrt(double(SIMD_EPSILON));

// What moves, seen from the tree's frame in the world's unit: a box that holds it, about its origin.
struct Mover {
  btVector3 center, halfExtent;
};

Mover moverOf(const btTriangleConvexcastCallback& callback, const btTransform& worldFromTree) {
  const btConvexShape& convex = *callback.m_convexShape;
  const btScalar disc = convex.getAngularMotionDisc();
  Mover mover{btVector3(0, 0, 0), btVector3(disc, disc, disc)};
  if (callback.m_convexShapeFrom.getBasis() == callback.m_convexShapeTo.getBasis()) {
    btVector3 lower, upper;
    convex.getAabb(btTransform(worldFromTree.getBasis().transposeTimes(callback.m_convexShapeFrom.getBasis())), lower,
                   upper);
    const btScalar noise = btScalar(kTurnNoise) * disc;
    mover = {(lower + upper) / 2, (upper - lower) / 2 + btVector3(noise, noise, noise)};
  }
  const btScalar grow = btScalar(kContactRadius) + callback.m_triangleCollisionMargin +
                        std::max(btScalar(0), -callback.m_allowedPenetration);
  mover.halfExtent += btVector3(grow, grow, grow);
  return mover;
}

SweptBox sweptBox(const SphereTreeShape& shape, const btTriangleConvexcastCallback& callback) {
  const btTransform worldFromTree = callback.m_triangleToWorld * shape.bodyFromTree();
  const double scale = double(shape.scale());
  const Mover mover = moverOf(callback, worldFromTree);
  const btVector3 from = worldFromTree.invXform(callback.m_convexShapeFrom.getOrigin()) + mover.center;
  const btVector3 to = worldFromTree.invXform(callback.m_convexShapeTo.getOrigin()) + mover.center;
  const double farthest = double(
      std::max({from.length(), to.length(), callback.m_convexShapeFrom.getOrigin().length(),
                callback.m_convexShapeTo.getOrigin().length(), callback.m_triangleToWorld.getOrigin().length()}));
  const Segment path(toVec3d(from) / scale, toVec3d(to) / scale, roundingSlack(shape, farthest));
  return {path, Vec3(toVec3d(mover.halfExtent) / scale)};
}

// Bullet's test of a triangle, with an ear for what the callback answers.
class Caster final : public btTriangleConvexcastCallback {
 public:
  explicit Caster(btTriangleConvexcastCallback& callback)
      : btTriangleConvexcastCallback(callback.m_convexShape, callback.m_convexShapeFrom, callback.m_convexShapeTo,
                                     callback.m_triangleToWorld, callback.m_triangleCollisionMargin),
        callback_(callback) {
    m_hitFraction = callback.m_hitFraction;
    m_allowedPenetration = callback.m_allowedPenetration;
  }
  btScalar reportHit(const btVector3& normal, const btVector3& point, btScalar fraction, int part,
                     int triangle) override {
    const btScalar answer = callback_.reportHit(normal, point, fraction, part, triangle);
    if (answer == fraction) m_hitFraction = std::min(m_hitFraction, fraction);
    return answer;
  }

 private:
  btTriangleConvexcastCallback& callback_;
};

struct Candidate {
  float at;
  std::uint32_t triangle;
};

float entryOf(const SweptBox& box, const SphereTree& tree, std::uint32_t triangle, float end) {
  const auto& corners = tree.triangles()[triangle];
  Vec3 lower = tree.vertices()[corners[0]], upper = lower;
  for (const std::uint32_t c : {corners[1], corners[2]})
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], tree.vertices()[c][axis]);
      upper[axis] = std::max(upper[axis], tree.vertices()[c][axis]);
    }
  return box.entryOf(lower, upper, end);
}

// The leaf's triangles the box can meet, those first that it can meet first.
void candidatesOf(const SphereTree& tree, NodeId leaf, const SweptBox& box, float end, SeenTriangles& seen,
                  std::vector<Candidate>& candidates) {
  candidates.clear();
  for (const std::uint32_t triangle : tree.regionTriangles(leaf)) {
    if (!seen.insert(triangle)) continue;
    const float at = entryOf(box, tree, triangle, end);
    if (at <= end) candidates.push_back({at, triangle});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
  });
}

}  // namespace

bool castConvex(const SphereTreeShape& shape, btTriangleConvexcastCallback& callback) {
  const SphereTree& tree = shape.tree();
  const SweptBox box = sweptBox(shape, callback);
  if (!box.path().isSane()) return false;
  Caster caster(callback);
  SeenTriangles seen(tree.triangles().size());
  std::vector<Candidate> candidates;
  const auto end = [&] { return box.path().placeOf(double(caster.m_hitFraction)); };
  walkLeaves(
      tree,
      [&](const Family& family, std::uint32_t living, float until) { return box.entriesOf(family, living, until); },
      end,
      [&](NodeId leaf) {
        candidatesOf(tree, leaf, box, end(), seen, candidates);
        for (const Candidate& candidate : candidates) {
          if (candidate.at > end()) return;
          PlacedTriangle triangle(shape, candidate.triangle);
          caster.processTriangle(triangle.corners, 0, static_cast<int>(candidate.triangle));
        }
      });
  return true;
}

}  // namespace cairn::bullet
