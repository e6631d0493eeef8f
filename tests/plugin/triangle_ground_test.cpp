// SPDX-License-Identifier: Zlib
// Ground made of triangles holds what falls, lies or slides on it, on its faces, edges and corners, and from both
// sides.
#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"
#include "triangle_grounds.h"

namespace cairn::test::triangle_ground_test {
namespace {

struct Brick {
  const char* name;
  Vec3d size;
  int cells;
};

void PrintTo(const Brick& brick, std::ostream* out) {
  *out << brick.name;
}

constexpr Brick kCube{"cube", {0.6, 0.5, 0.4}, 4};
constexpr Brick kRod{"rod", {3, 0.3, 0.3}, 3};
constexpr Brick kPlate{"plate", {1.2, 1.2, 0.12}, 6};

// Height of the lowest corner.
btScalar lowestOf(const btRigidBody& body, const Vec3d& size) {
  btScalar lowest = 1e9F;
  for (int c = 0; c < 8; ++c) {
    const btVector3 corner(btScalar(c & 1 ? 0.5 : -0.5) * btScalar(size.x),
                           btScalar(c & 2 ? 0.5 : -0.5) * btScalar(size.y),
                           btScalar(c & 4 ? 0.5 : -0.5) * btScalar(size.z));
    lowest = std::min(lowest, (body.getWorldTransform() * corner).z());
  }
  return lowest;
}

void setHeight(btRigidBody& body, btScalar z) {
  btTransform t = body.getWorldTransform();
  t.getOrigin().setZ(z);
  body.setWorldTransform(t);
  body.setInterpolationWorldTransform(t);
}

class TriangleGroundHolds : public testing::TestWithParam<std::tuple<TriangleGround, Brick>> {};

// However it lands and slides, at the end it lies on the ground: as exactly as on a plane.
TEST_P(TriangleGroundHolds, WhateverFallsOnIt) {
  const auto& [kind, brick] = GetParam();
  const auto shape = treeShape(plainTree(cuboid(brick.size, brick.cells)));
  const auto ground = flatGround(kind);
  const btScalar tolerance = bullet::kSpeculativeFraction * btScalar(length(brick.size));
  for (unsigned seed = 1; seed <= 16; ++seed) {
    std::mt19937 engine(seed);
    const auto within = [&](double lower, double upper) {
      return btScalar(lower + (upper - lower) * (engine() / 4294967296.0));
    };
    BulletWorld<> w;
    w.add(ground, 0, btVector3(0, 0, 0));
    const btVector3 axis(within(-1, 1), within(-1, 1), within(-1, 1));
    const btVector3 place(within(-3, 3), within(-3, 3), 0);
    btRigidBody& body = w.add(shape, 1, place, btQuaternion(axis.normalized(), within(0, 3)));
    setHeight(body, btScalar(0.1) - lowestOf(body, brick.size));
    const btVector3 push(within(-4, 4), 0, within(-2, 0));
    body.setLinearVelocity(push);
    w.step(420);
    ASSERT_TRUE(isSane(body)) << brick.name << ", seed " << seed;
    EXPECT_GT(lowestOf(body, brick.size), -tolerance) << brick.name << ", seed " << seed;
    EXPECT_LT(lowestOf(body, brick.size), tolerance) << brick.name << ", seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Grounds, TriangleGroundHolds,
                         testing::Combine(testing::Values(TriangleGround::mesh, TriangleGround::scaledMesh,
                                                          TriangleGround::terrain, TriangleGround::gimpact),
                                          testing::Values(kCube, kRod, kPlate)));

class OnFlatMesh : public testing::TestWithParam<btVector3> {
 protected:
  void addGround(BulletWorld<>& w) {
    w.add(flatGround(TriangleGround::mesh), 0, GetParam() - btVector3(btScalar(0.3), btScalar(0.2), 0));
  }
};

// Leaves' centres stand exactly over edges and corners of the ground, above it or below.
TEST_P(OnFlatMesh, ABodyRestsAndComesUp) {
  for (const Brick& brick : {kCube, kPlate})
    for (const double sunk : {-0.02, 0.02}) {
      BulletWorld<> w;
      addGround(w);
      btRigidBody& body =
          w.add(treeShape(plainTree(cuboid(brick.size, 2))), 1, btVector3(0, 0, btScalar(0.5 * brick.size.z - sunk)));
      w.step(240);
      const btScalar tolerance = bullet::kSpeculativeFraction * btScalar(length(brick.size));
      EXPECT_NEAR(lowestOf(body, brick.size), 0, tolerance) << brick.name << " sunk by " << sunk;
      EXPECT_GT(body.getWorldTransform().getBasis()[2][2], 0.999) << "tilted";
    }
}

TEST_P(OnFlatMesh, ABallDroppedRests) {
  BulletWorld<> w;
  addGround(w);
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.3, 10))), 1, btVector3(0, 0, btScalar(0.6)));
  w.step(300);
  EXPECT_LT(body.getLinearVelocity().length(), 0.01);
  // The inscribed polyhedron is lower than the ball by at most the sagitta of a facet, which spans 9 degrees or less.
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.3,
              0.3 * (1 - std::cos(0.08)) + bullet::kSpeculativeFraction * 0.6 * 1.7320508);
}

// Nothing on flat ground catches what slides: without friction it keeps its speed over eight edges of each kind.
TEST_P(OnFlatMesh, NothingCatchesASlidingBrick) {
  BulletWorld<> w;
  addGround(w);
  btRigidBody& body = w.add(treeShape(plainTree(cuboid(kCube.size, 4))), 1, btVector3(-4, 0, btScalar(0.2)));
  body.setFriction(0);
  body.setLinearVelocity(btVector3(2, 0, 0));
  w.step(240);
  EXPECT_NEAR(body.getLinearVelocity().x(), 2, 0.02);
  EXPECT_NEAR(body.getLinearVelocity().y(), 0, 0.02);
  EXPECT_NEAR(lowestOf(body, kCube.size), 0, bullet::kSpeculativeFraction * btScalar(length(kCube.size)));
}

// Offsets of the ground's corner from the body's middle: a corner, the middles of both kinds of edge, a face.
INSTANTIATE_TEST_SUITE_P(Places, OnFlatMesh,
                         testing::Values(btVector3(0, 0, 0), btVector3(btScalar(0.5), 0, 0),
                                         btVector3(btScalar(0.5), btScalar(0.5), 0),
                                         btVector3(btScalar(0.3), btScalar(0.1), 0)));

// A roof of 45 degrees along y, its ridge at height 0, open below.
std::vector<btVector3> roof() {
  const btVector3 front(0, -2, 0), back(0, 2, 0);
  const btVector3 left(-2, -2, -2), farLeft(-2, 2, -2), right(2, -2, -2), farRight(2, 2, -2);
  return {front, back, left, back, farLeft, left, front, right, back, right, farRight, back};
}

TEST(OnARidge, ABallHeldUprightRests) {
  BulletWorld<> w;
  w.add(meshOf(roof()), 0, btVector3(0, 0, 0));
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.3, 10))), 1, btVector3(0, 0, btScalar(0.5)));
  body.setLinearFactor(btVector3(0, 0, 1));
  body.setAngularFactor(btVector3(0, 0, 0));
  w.step(240);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.3, bullet::kSpeculativeFraction * 0.6 * 1.7320508);
}

// A sheet between two slabs of one body: neither side is the inside, nothing is deep, nothing may move.
TEST(AroundAThinWall, ABodyIsNotPulledThrough) {
  const btScalar far = 3;
  for (const double thickness : {0.02, 0.04, 0.1})
    for (const btScalar separation : {btScalar(-0.001), btScalar(0.002), btScalar(0.01)})
      for (const int cells : {2, 4, 6}) {
        BulletWorld<> w;
        w.world.setGravity(btVector3(0, 0, 0));
        const btScalar at =
            btScalar(0.3 - thickness / 2) - separation;  // the centre of mass is on the other side than a slab
        const btVector3 a(at, -far, -far), b(at, far, -far), c(at, far, far), d(at, -far, far);
        w.add(meshOf({a, b, c, a, c, d}), 0, btVector3(0, 0, 0));
        btRigidBody& body =
            w.add(treeShape(plainTree(twoCuboids({thickness, 1, 1}, {0.6, 0, 0}, cells))), 1, btVector3(0, 0, 0));
        w.step(60);
        // Bullet takes a fifth of the millimetre it overlaps by out in a step, as a speed that nothing stops
        // afterwards.
        EXPECT_LT(body.getWorldTransform().getOrigin().length(), 0.0125)
            << "slabs of " << thickness << " m, gap " << separation << ", " << cells << " cells";
      }
}

// A body on one side of a single sheet stays there, whichever way its triangles are wound.
TEST(OnASheet, BothSidesHold) {
  for (const bool isTurned : {false, true})
    for (const btScalar up : {btScalar(1), btScalar(-1)}) {
      BulletWorld<> w;
      w.world.setGravity(btVector3(0, 0, btScalar(-9.81) * up));
      const btVector3 a(-3, -3, 0), b(3, -3, 0), c(3, 3, 0), d(-3, 3, 0);
      const std::vector<btVector3> sheet = isTurned ? std::vector{a, c, b, a, d, c} : std::vector{a, b, c, a, c, d};
      w.add(meshOf(sheet), 0, btVector3(0, 0, 0));
      btRigidBody& body = w.add(treeShape(plainTree(cuboid(kPlate.size, kPlate.cells))), 1,
                                btVector3(btScalar(0.1), 0, up * btScalar(0.1)));
      w.step(180);
      const btScalar tolerance = bullet::kSpeculativeFraction * btScalar(length(kPlate.size));
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z() * up, 0.06, tolerance) << "turned " << isTurned;
    }
}

// Its nearest point is the centre itself, or so near that squares underflow, and it has no normal. What a fast body's
// traversal has ruled out may be near in the next step, so with nothing to spend the whole body's sphere stands in, at
// depth zero as all that is new.
TEST(WithoutArea, ThroughTheCentreStillHasADirection) {
  const btVector3 low(-1, -1, 0), high(1, 1, 0), point(0, 0, 0), upright(0, 0, 1);
  const auto tree = plainTree(cuboid({1, 1, 1}, 4));
  for (const std::vector<btVector3>& corners :
       {std::vector{low, low, high}, std::vector{point, point, point}, std::vector{-upright, upright, upright}})
    for (const btScalar beside : {0.0F, 1e-21F, 1e-24F}) {
      BulletWorld<> w;
      w.add(meshOf(corners), 0, btVector3(0, 0, 0));
      const Vec3d off = -tree->origin();
      btRigidBody& body =
          w.add(treeShape(tree), 1, btVector3(btScalar(off.x) + beside, btScalar(off.y), btScalar(off.z)));
      body.setLinearVelocity(btVector3(100, 0, 0));
      ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
      for (int step = 0; step < 2; ++step) w.world.performDiscreteCollisionDetection();
      int ofWholes = 0;
      for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i)
        for (int k = 0; k < w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts(); ++k) {
          const btManifoldPoint& p = w.dispatcher.getManifoldByIndexInternal(i)->getContactPoint(k);
          EXPECT_NEAR(p.m_normalWorldOnB.length(), 1, 1e-5);
          EXPECT_EQ(p.getDistance(), 0);
          if (p.m_partId0 == 0 && p.m_index0 == 0 && p.m_partId1 == 0 && p.m_index1 == 0) ++ofWholes;
        }
      EXPECT_GT(ofWholes, 0) << "the test shows nothing";
    }
}

}  // namespace
}  // namespace cairn::test::triangle_ground_test
