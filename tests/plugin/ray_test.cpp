// SPDX-License-Identifier: Zlib
// Rays at a sphere-tree: the same hits as from all triangles one by one, through every way Bullet asks.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "bullet_world.h"
#include "casts.h"
#include "ray_hits.h"

namespace cairn::test::ray_test {
namespace {

using Flags = btTriangleRaycastCallback::EFlags;
constexpr unsigned int kEveryFlags[] = {Flags::kF_None, Flags::kF_FilterBackfaces, Flags::kF_KeepUnflippedNormal,
                                        Flags::kF_FilterBackfaces | Flags::kF_KeepUnflippedNormal};

std::vector<std::shared_ptr<bullet::SphereTreeShape>> everyShape() {
  return {treeShape(plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 6), 3), btScalar(1.7)),
          treeShape(plainTree(ball(1, 12), 200), btScalar(0.01)), treeShape(plainTree(torus(1, 0.3, 24), 2)),
          treeShape(plainTree(cuboid({1, 1, 1}, 1), 1), btScalar(30)),
          treeShape(withTwoSpheres(*plainTree(torus(1, 0.4, 16), 2), 7))};
}

TEST(Ray, FindsWhatAllTrianglesGiveWhateverIsAskedFor) {
  constexpr std::uint64_t kSeed = 20;
  std::mt19937_64 engine(kSeed);
  RayTotals totals;
  for (const auto& shape : everyShape())
    for (int trial = 0; trial < 4000; ++trial) {
      // From within the body to three hundred of its sizes away.
      const Way way = randomWay(engine, double(shape->size()), std::pow(10, uniform(engine, -1, 2.5)));
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      expectSameHits(*shape, way, kEveryFlags[engine() % 4], trial % 2 == 0, totals);
      if (testing::Test::HasFatalFailure()) return;
    }
  EXPECT_GT(totals.hits, totals.rays / 8);
  std::printf("%zu rays, %zu hit; %.1f triangles asked a ray, of %.0f\n", totals.rays, totals.hits,
              double(totals.asked) / double(totals.rays), double(totals.triangles) / double(totals.rays));
}

// Rays in the planes of faces, through corners and along edges: what is a hit there is decided by roundings, which must
// be the same.
TEST(Ray, AlongEdgesAndFacesFindsWhatAllTrianglesGive) {
  constexpr std::uint64_t kSeed = 21;
  std::mt19937_64 engine(kSeed);
  RayTotals totals;
  for (const double scale : {1.0, 0.3}) {
    const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 4), 2), btScalar(scale));
    const auto onGrid = [&] { return scale * (static_cast<double>(engine() % 9) / 8 - 0.5); };
    for (int trial = 0; trial < 4000; ++trial) {
      Vec3d from(onGrid(), onGrid(), onGrid()), to(onGrid(), onGrid(), onGrid());
      from[static_cast<int>(engine() % 3)] = scale * (engine() % 2 == 0 ? 2 : -2);
      if (engine() % 2 == 0) to = from;
      to[static_cast<int>(engine() % 3)] = scale * (engine() % 2 == 0 ? 3 : -3);
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      expectSameHits(*shape, {toBt(from), toBt(to)}, kEveryFlags[engine() % 4], trial % 2 == 0, totals);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(totals.hits, totals.rays / 8);
}

TEST(Ray, AsksFewOfManyTriangles) {
  constexpr std::uint64_t kSeed = 22;
  std::mt19937_64 engine(kSeed);
  for (const int segments : {24, 48, 96}) {
    const Solid solid = torus(1, 0.4, segments);
    // As many leaves each time: what is saved inside them counts as well.
    const auto shape = treeShape(plainTree(solid, static_cast<std::uint32_t>(solid.triangles.size() / 64)));
    RayTotals totals;
    for (int trial = 0; trial < 200; ++trial)
      expectSameHits(*shape, randomWay(engine, double(shape->size()), 2), 0, true, totals);
    const double asked = double(totals.asked) / double(totals.rays);
    std::printf("%zu triangles: %.1f asked a ray\n", shape->tree().triangles().size(), asked);
    // No more than lie along a line across a square of them; a single leaf of the largest torus has more.
    EXPECT_LT(asked, std::sqrt(double(shape->tree().triangles().size()))) << "seed " << kSeed;
  }
}

TEST(Ray, EndsWhereTheCallbackSaysSo) {
  struct First final : btTriangleRaycastCallback {
    using btTriangleRaycastCallback::btTriangleRaycastCallback;
    int reports = 0;
    btScalar reportHit(const btVector3&, btScalar, int, int) override { return ++reports, btScalar(0); }
  };
  const auto shape = treeShape(plainTree(twoCuboids({1, 1, 1}, {2, 0, 0}, 4), 2));
  First first(btVector3(-5, btScalar(0.1), btScalar(0.2)), btVector3(5, btScalar(0.1), btScalar(0.2)));
  shape->processAllTriangles(&first, btVector3(0, 0, 0), btVector3(0, 0, 0));
  EXPECT_EQ(first.reports, 1);
}

// A user's callback may look around from where it has been told of a hit.
TEST(Ray, MayBeCastInsideAnother) {
  struct Nested final : btTriangleRaycastCallback {
    Nested(const bullet::SphereTreeShape& s, const btVector3& from, const btVector3& to, int levels)
        : btTriangleRaycastCallback(from, to), shape(s), deeper(levels) {}
    btScalar reportHit(const btVector3&, btScalar, int, int triangle) override {
      hits.push_back(triangle);
      if (deeper > 0) {
        Nested inside(shape, m_to, m_from, deeper - 1);
        shape.processAllTriangles(&inside, btVector3(0, 0, 0), btVector3(0, 0, 0));
        EXPECT_EQ(inside.hits.size(), 4U);
      }
      return 1;
    }
    const bullet::SphereTreeShape& shape;
    int deeper;
    std::vector<int> hits;
  };
  const auto shape = treeShape(plainTree(twoCuboids({1, 1, 1}, {2, 0, 0}, 4), 2));
  Nested outer(*shape, btVector3(-5, btScalar(0.11), btScalar(0.23)), btVector3(5, btScalar(0.11), btScalar(0.23)), 2);
  shape->processAllTriangles(&outer, btVector3(0, 0, 0), btVector3(0, 0, 0));
  EXPECT_EQ(std::set<int>(outer.hits.begin(), outer.hits.end()).size(), 4U) << "in and out of both cuboids";
  EXPECT_EQ(outer.hits.size(), 4U) << "each triangle once";
}

TEST(Ray, ThatHasNoLengthOrNoEndIsAnswered) {
  const auto shape = treeShape(plainTree(ball(1, 6), 4));
  const btScalar end = std::numeric_limits<btScalar>::infinity(), none = std::numeric_limits<btScalar>::quiet_NaN();
  for (const btVector3& to : {btVector3(0, 0, 0), btVector3(end, 0, 0), btVector3(none, 0, 0)}) {
    RayHits all({btVector3(0, 0, 0), to}, 0, true);
    shape->processAllTriangles(&all, btVector3(0, 0, 0), to);
    EXPECT_TRUE(all.hits.empty());
  }
  RayHits far({btVector3(btScalar(0.1), btScalar(0.2), -3), btVector3(btScalar(0.1), btScalar(0.2), btScalar(1e6))}, 0,
              true);
  shape->processAllTriangles(&far, far.m_from, far.m_to);
  EXPECT_EQ(far.hits.size(), 2U);
}

// Three bodies of the same triangles at the same place: hits are told beside Bullet's own mesh shape, and lead back to
// the mesh and to the tree.
struct PlacedBody {
  explicit PlacedBody(std::shared_ptr<const SphereTree> tree)
      : shape(
            bullet::SphereTreeShape::create(std::move(tree), bullet::BodyFrame::principalAxes, btScalar(1.3)).value()) {
    copyTriangles(*shape, mesh);
    bvh = std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
  }
  std::shared_ptr<bullet::SphereTreeShape> shape;
  btTriangleMesh mesh;
  std::shared_ptr<btBvhTriangleMeshShape> bvh;
};

struct Closest final : btCollisionWorld::ClosestRayResultCallback {
  using ClosestRayResultCallback::ClosestRayResultCallback;
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& hit, bool inWorld) override {
    part = hit.m_localShapeInfo->m_shapePart;
    triangle = hit.m_localShapeInfo->m_triangleIndex;
    return ClosestRayResultCallback::addSingleResult(hit, inWorld);
  }
  int part = -1, triangle = -1;
};

TEST(Ray, ThroughTheWorldHitsWhatBulletsMeshShapeHits) {
  constexpr std::uint64_t kSeed = 23;
  std::mt19937_64 engine(kSeed);
  PlacedBody body(plainTree(torus(1, 0.3, 24), 4));
  int hits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const btTransform at = randomTransform(engine);
    BulletWorld<> trees, meshes;
    btRigidBody& tree = trees.add(body.shape, trial % 2, at.getOrigin(), at.getRotation());
    meshes.add(body.bvh, 0, at.getOrigin(), at.getRotation());
    const Way local = randomWay(engine, double(body.shape->size()), 2);
    const btVector3 from = at * local.from, to = at * local.to;
    Closest ours(from, to), theirs(from, to);
    trees.world.rayTest(from, to, ours);
    meshes.world.rayTest(from, to, theirs);
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
    ASSERT_EQ(ours.hasHit(), theirs.hasHit());
    btCollisionWorld::AllHitsRayResultCallback allOurs(from, to), allTheirs(from, to);
    trees.world.rayTest(from, to, allOurs);
    meshes.world.rayTest(from, to, allTheirs);
    ASSERT_EQ(allOurs.m_hitFractions.size(), allTheirs.m_hitFractions.size());
    if (!ours.hasHit()) continue;
    ++hits;
    EXPECT_EQ(ours.m_closestHitFraction, theirs.m_closestHitFraction) << "the same arithmetic on the same triangle";
    EXPECT_LT((ours.m_hitNormalWorld - theirs.m_hitNormalWorld).length(), 1e-5);
    EXPECT_EQ(ours.m_collisionObject, &tree);
    EXPECT_EQ(ours.part, 0);
    const btVector3 point = at.invXform(ours.m_hitPointWorld);
    const auto leaf = body.shape->leafOf(ours.triangle, point);
    ASSERT_TRUE(leaf) << "the hit leads back to a node";
    const auto region = body.shape->tree().regionTriangles(*leaf);
    EXPECT_NE(std::find(region.begin(), region.end(), static_cast<std::uint32_t>(ours.triangle)), region.end());
  }
  EXPECT_GT(hits, 40);
}

TEST(Ray, FindsTheTreeInsideACompound) {
  const auto child = treeShape(plainTree(cuboid({1, 1, 1}, 2)));
  auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 2)), child.get());
  BulletWorld<> w;
  w.add(compound, 0, btVector3(1, 0, 0));
  Closest hit(btVector3(btScalar(1.1), btScalar(0.2), 9), btVector3(btScalar(1.1), btScalar(0.2), -1));
  w.world.rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_NEAR(hit.m_closestHitFraction, 0.65, 1e-6);
  EXPECT_NEAR(hit.m_hitNormalWorld.z(), 1, 1e-6);
}

// All leaves' balls one by one, in double.
std::vector<double> entriesOfAllLeaves(const bullet::SphereTreeShape& shape, const Way& way) {
  std::vector<double> fractions;
  const SphereTree& tree = shape.tree();
  const auto at = [](const btVector3& v) { return Vec3d(double(v.x()), double(v.y()), double(v.z())); };
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    const NodeId node = tree.nodeAt(record);
    if (!tree.isLeaf(node)) continue;
    const Sphere s = tree.sphere(node);
    const Vec3d center = at(shape.bodyFromTree() * (toBt(Vec3d(s.center)) * shape.scale()));
    const double radius = double(s.radius) * double(shape.scale()) + double(shape.getMargin());
    const Vec3d d = at(way.to) - at(way.from), m = at(way.from) - center;
    const double a = lengthSq(d), b = dot(m, d), c = lengthSq(m) - radius * radius;
    if (c <= 0 || b * b - a * c < 0) continue;
    const double fraction = (-b - std::sqrt(b * b - a * c)) / a;
    if (fraction >= 0 && fraction < 1) fractions.push_back(fraction);
  }
  std::sort(fractions.begin(), fractions.end());
  return fractions;
}

TEST(Ray, AtSpheresEntersEveryLeafsBall) {
  constexpr std::uint64_t kSeed = 24;
  std::mt19937_64 engine(kSeed);
  int hits = 0;
  for (const auto& shape : everyShape()) {
    shape->setCastTarget(bullet::CastTarget::spheres);
    for (int trial = 0; trial < 500; ++trial) {
      shape->setMargin(trial % 2 == 0 ? btScalar(0) : shape->size() / 20);
      const Way way = randomWay(engine, double(shape->size()), 2);
      RayHits all(way, 0, true), closest(way, 0, false);
      shape->processAllTriangles(&all, way.from, way.to);
      shape->processAllTriangles(&closest, way.from, way.to);
      const std::vector<double> expected = entriesOfAllLeaves(*shape, way);
      std::sort(all.hits.begin(), all.hits.end(), [](const Hit& a, const Hit& b) { return a.fraction < b.fraction; });
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      ASSERT_EQ(all.hits.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(double(all.hits[i].fraction), expected[i], 1e-5);
      ASSERT_EQ(closest.hits.empty(), expected.empty());
      if (expected.empty()) continue;
      ++hits;
      EXPECT_NEAR(double(closest.hits.back().fraction), expected[0], 1e-5);
      const auto node = static_cast<NodeId>(closest.hits.back().triangle);
      EXPECT_TRUE(shape->tree().isLeaf(node));
      EXPECT_EQ(closest.hits.back().part, static_cast<int>(shape->tree().level(node)));
      EXPECT_NEAR(closest.hits.back().normal.length(), 1, 1e-5);
      EXPECT_LT(closest.hits.back().normal.dot(way.to - way.from), 0);
    }
  }
  EXPECT_GT(hits, 400);
}

}  // namespace
}  // namespace cairn::test::ray_test
