// SPDX-License-Identifier: Zlib
// Convex shapes swept at a sphere-tree: the closest hit of all triangles one by one, and of Bullet's own mesh shape.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <set>
#include <vector>

#include "bullet_world.h"
#include "casts.h"

namespace cairn::test::sweep_test {
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
        const auto shape = treeShape(plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3), trial % 4 < 2 ? 3 : 50),
                                     btScalar(scale));
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

TEST(Sweep, ThroughTheWorldStopsWhereItDoesAtBulletsMeshShape) {
  constexpr std::uint64_t kSeed = 31;
  std::mt19937_64 engine(kSeed);
  const auto shape = treeShape(plainTree(torus(1, 0.3, 12), 4));
  btTriangleMesh mesh;
  copyTriangles(*shape, mesh);
  const auto bvh = std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
  bvh->setMargin(0);
  int hits = 0;
  for (const auto& convex : everyConvex(btScalar(0.15)))
    for (int trial = 0; trial < 40; ++trial) {
      const btTransform at = randomTransform(engine);
      BulletWorld<> trees, meshes;
      trees.add(shape, trial % 2, at.getOrigin(), at.getRotation());
      meshes.add(bvh, 0, at.getOrigin(), at.getRotation());
      Sweep sweep = randomSweep(engine, *convex, 2, false);
      sweep.from = at * sweep.from;
      sweep.to = at * sweep.to;
      btCollisionWorld::ClosestConvexResultCallback ours(sweep.from.getOrigin(), sweep.to.getOrigin());
      btCollisionWorld::ClosestConvexResultCallback theirs(sweep.from.getOrigin(), sweep.to.getOrigin());
      trees.world.convexSweepTest(sweep.shape, sweep.from, sweep.to, ours);
      meshes.world.convexSweepTest(sweep.shape, sweep.from, sweep.to, theirs);
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      ASSERT_EQ(ours.hasHit(), theirs.hasHit());
      EXPECT_EQ(ours.m_closestHitFraction, theirs.m_closestHitFraction) << "the same cast at the same triangle";
      hits += ours.hasHit() ? 1 : 0;
    }
  EXPECT_GT(hits, 50);
}

// The oracle: Bullet's own compound of the leaves' balls.
TEST(Sweep, AtSpheresStopsWhereACompoundOfThemDoes) {
  constexpr std::uint64_t kSeed = 32;
  std::mt19937_64 engine(kSeed);
  const auto shape = treeShape(plainTree(torus(1, 0.3, 12), 4), btScalar(0.7));
  shape->setCastTarget(bullet::CastTarget::spheres);
  shape->setMargin(btScalar(0.02));
  btCompoundShape compound;
  std::vector<std::unique_ptr<btSphereShape>> balls;
  for (std::uint32_t record = 0; record < shape->tree().nodeCount(); ++record) {
    const NodeId node = shape->tree().nodeAt(record);
    if (!shape->tree().isLeaf(node)) continue;
    const Sphere s = shape->tree().sphere(node);
    balls.push_back(std::make_unique<btSphereShape>(btScalar(s.radius) * shape->scale() + shape->getMargin()));
    const btVector3 center = shape->bodyFromTree() * (toBt(Vec3d(s.center)) * shape->scale());
    compound.addChildShape(btTransform(btQuaternion::getIdentity(), center), balls.back().get());
  }
  int hits = 0;
  for (const auto& convex : everyConvex(btScalar(0.1)))
    for (int trial = 0; trial < 40; ++trial) {
      const Sweep sweep = randomSweep(engine, *convex, 1.5, trial % 2 == 1);
      const auto ours = closest(sweep, *shape, 0), theirs = closest(sweep, compound, 0);
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      ASSERT_EQ(ours.hasHit(), theirs.hasHit());
      EXPECT_NEAR(ours.m_closestHitFraction, theirs.m_closestHitFraction, 1e-5);
      hits += ours.hasHit() ? 1 : 0;
    }
  EXPECT_GT(hits, 50);
}

// Bullet's cast ends a millimetre before contact, and a shape's margin comes on top: what passes by so near is a hit.
TEST(Sweep, ThatPassesWithinBulletsReachHitsAsAllTrianglesSay) {
  const btScalar radius(0.1);
  const btSphereShape ball(radius);
  for (const btScalar margin : {btScalar(0), btScalar(0.05)})
    for (const btScalar away : {btScalar(0.0005), btScalar(0.002)}) {
      const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 4), 2));
      shape->setMargin(margin);
      btTransform from = btTransform::getIdentity(), to = from;
      from.setOrigin(btVector3(-2, btScalar(0.07), btScalar(0.5) + radius + margin + away));
      to.setOrigin(btVector3(2, btScalar(0.07), btScalar(0.5) + radius + margin + away));
      const Sweep sweep{&ball, from, to};
      CollectAll all = collectorOf(sweep, *shape, 0), fast = collectorOf(sweep, *shape, 0);
      castOverAll(*shape, all);
      shape->processAllTriangles(&fast, btVector3(0, 0, 0), btVector3(0, 0, 0));
      EXPECT_EQ(all.hits.empty(), away > btScalar(0.001)) << "margin " << margin << ", " << away << " away";
      EXPECT_TRUE(fast.hits == all.hits) << fast.hits.size() << " hits instead of " << all.hits.size();
    }
}

TEST(Sweep, ThatOnlyTurnsIsAnswered) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 3), 2));
  const btBoxShape plank(btVector3(2, btScalar(0.1), btScalar(0.1)));
  btTransform from(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI * btScalar(0.98)), btVector3(-1, 0, 0));
  btTransform to(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI / 9), btVector3(-1, 0, 0));
  EXPECT_TRUE(closest({&plank, from, to}, *shape, 0).hasHit());
}

}  // namespace
}  // namespace cairn::test::sweep_test
