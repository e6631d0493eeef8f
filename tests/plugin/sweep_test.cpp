// SPDX-License-Identifier: Zlib
// Convex shapes swept at a sphere-tree: the closest hit of all triangles one by one, and of Bullet's own mesh shape.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <set>
#include <vector>

#include "bullet_world.h"
#include "casts.h"

namespace cairn::test {
namespace {

std::vector<std::shared_ptr<btConvexShape>> everyConvex(btScalar size) {
  const auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 8; ++i)
    hull->addPoint(btVector3(i & 1 ? size : -size / 2, i & 2 ? size / 3 : -size, i & 4 ? size : -size / 4));
  return {std::make_shared<btSphereShape>(size), std::make_shared<btBoxShape>(btVector3(size, size / 2, size / 5)),
          std::make_shared<btCapsuleShape>(size / 3, size),
          std::make_shared<btCylinderShape>(btVector3(size, size, size)), hull};
}

struct Sweep {
  const btConvexShape* shape;
  btTransform from, to;
};

Sweep randomSweep(std::mt19937_64& engine, const btConvexShape& convex, double size, bool turns) {
  const Way way = randomWay(engine, size, 3);
  btTransform from = randomTransform(engine), to = turns ? randomTransform(engine) : from;
  from.setOrigin(way.from);
  to.setOrigin(way.to);
  return {&convex, from, to};
}

btCollisionWorld::ClosestConvexResultCallback closest(const Sweep& sweep, btCollisionShape& shape,
                                                      btScalar penetration) {
  btCollisionObject object;
  object.setCollisionShape(&shape);
  btCollisionWorld::ClosestConvexResultCallback result(sweep.from.getOrigin(), sweep.to.getOrigin());
  btCollisionWorld::objectQuerySingle(sweep.shape, sweep.from, sweep.to, &object, &shape, object.getWorldTransform(),
                                      result, penetration);
  return result;
}

// Reports as Bullet's own bridge does, and keeps everything, farther and nearer.
struct CollectAll final : btTriangleConvexcastCallback {
  using btTriangleConvexcastCallback::btTriangleConvexcastCallback;
  btScalar reportHit(const btVector3&, const btVector3&, btScalar fraction, int part, int triangle) override {
    hits.insert({triangle, fraction});
    nearest = std::min(nearest, fraction);
    parts.insert(part);
    return 1;
  }
  std::multiset<std::pair<int, btScalar>> hits;
  std::set<int> parts;
  btScalar nearest = 1;
};

CollectAll collectorOf(const Sweep& sweep, const btConcaveShape& shape, btScalar penetration) {
  CollectAll all(sweep.shape, sweep.from, sweep.to, btTransform::getIdentity(), shape.getMargin());
  all.m_allowedPenetration = penetration;
  return all;
}

TEST(Sweep, FindsWhatAllTrianglesGive) {
  constexpr std::uint64_t kSeed = 30;
  std::mt19937_64 engine(kSeed);
  int hits = 0, sweeps = 0;
  for (const double scale : {1.0, 0.2})
    for (const auto& convex : everyConvex(btScalar(0.3 * scale)))
      for (int trial = 0; trial < 60; ++trial, ++sweeps) {
        const auto shape = treeShape(plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3), 3), btScalar(scale));
        const Sweep sweep = randomSweep(engine, *convex, scale, trial % 2 == 1);
        const btScalar penetration = trial % 3 == 0 ? btScalar(0.02) : btScalar(0);
        SCOPED_TRACE("seed " + std::to_string(kSeed) + ", sweep " + std::to_string(sweeps));
        CollectAll all = collectorOf(sweep, *shape, penetration), fast = collectorOf(sweep, *shape, penetration);
        castOverAll(*shape, all);
        shape->processAllTriangles(&fast, btVector3(0, 0, 0), btVector3(0, 0, 0));
        EXPECT_TRUE(fast.hits == all.hits) << fast.hits.size() << " hits instead of " << all.hits.size();
        EXPECT_EQ(closest(sweep, *shape, penetration).m_closestHitFraction, all.nearest);
        hits += all.hits.empty() ? 0 : 1;
      }
  EXPECT_GT(hits, sweeps / 5);
  std::printf("%d sweeps, %d hit\n", sweeps, hits);
}

}  // namespace
}  // namespace cairn::test
