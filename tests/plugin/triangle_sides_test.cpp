// SPDX-License-Identifier: Zlib
// A triangle has no inside: on which side of it a body belongs is told from where the body was, what it faces and where
// the rest of it is.
#include <gtest/gtest.h>

#include <LinearMath/btTransformUtil.h>

#include <random>

#include "bullet_world.h"
#include "contacts/relative_motion.h"
#include "counterparts/touched_sides.h"
#include "counterparts/triangle_sides.h"
#include "shape/bullet_math.h"
#include "triangle_grounds.h"

namespace cairn::test {
namespace {

using bullet::RelativeMotion;
using bullet::TouchedSides;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  btScalar operator()(double lower, double upper) {
    return btScalar(lower + (upper - lower) * (engine_() / 4294967296.0));
  }
  btVector3 vector(double bound) {
    const btScalar x = (*this)(-bound, bound), y = (*this)(-bound, bound);
    return {x, y, (*this)(-bound, bound)};
  }
  btQuaternion turn() { return {vector(1).normalized(), (*this)(0, 3)}; }

 private:
  std::mt19937 engine_;
};

// Triangles of a parallelogram cut into cells.
void addPatch(std::vector<btVector3>& corners, const btVector3& at, const btVector3& u, const btVector3& v, int cells) {
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const auto point = [&](int di, int dj) {
        return at + u * (btScalar(i + di) / btScalar(cells)) + v * (btScalar(j + dj) / btScalar(cells));
      };
      corners.insert(corners.end(), {point(0, 0), point(1, 0), point(1, 1), point(0, 0), point(1, 1), point(0, 1)});
    }
}

std::vector<btVector3> boxMesh(const btVector3& lower, const btVector3& upper, int cells) {
  const btVector3 d = upper - lower, x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
  std::vector<btVector3> corners;
  addPatch(corners, lower, y, x, cells);
  addPatch(corners, lower, x, z, cells);
  addPatch(corners, lower, z, y, cells);
  addPatch(corners, lower + z, x, y, cells);
  addPatch(corners, lower + y, z, x, cells);
  addPatch(corners, lower + x, y, z, cells);
  return corners;
}

void moveTo(btRigidBody& body, const btVector3& origin) {
  const btTransform t(body.getWorldTransform().getRotation(), origin);
  body.setWorldTransform(t);
  body.setInterpolationWorldTransform(t);
}

// Least distance in front of a plane of any vertex of the solid the body was made from.
btScalar lowest(const btRigidBody& body, const Solid& solid, const btVector3& normal, btScalar offset) {
  const auto& shape = static_cast<const bullet::SphereTreeShape&>(*body.getCollisionShape());
  const Vec3d center(Vec3(massOf(solid).centerOfMass));
  btScalar least = std::numeric_limits<btScalar>::max();
  for (const Vec3d& v : solid.vertices) {
    const Vec3d p = v - center;
    const btVector3 inBody = shape.bodyFromTree() * btVector3(btScalar(p.x), btScalar(p.y), btScalar(p.z));
    least = std::min(least, (body.getWorldTransform() * inBody).dot(normal) - offset);
  }
  return least;
}

struct Thrown {
  const char* name;
  Solid solid;
};

// A floor and two walls: what is thrown into their corner comes to rest in front of all three.
TEST(ThrownIntoACorner, FlatBodiesComeOutAgain) {
  std::vector<btVector3> room;
  addPatch(room, {-4, -4, 0}, {6, 0, 0}, {0, 6, 0}, 6);
  addPatch(room, {2, -4, 0}, {0, 6, 0}, {0, 0, 6}, 6);
  addPatch(room, {-4, 2, 0}, {6, 0, 0}, {0, 0, 6}, 6);
  const auto shape = meshOf(room);
  for (const Thrown& thrown : {Thrown{"plate", cuboid({0.7, 0.7, 0.07}, 8)}, Thrown{"rod", cuboid({1, 0.08, 0.08}, 6)}})
    for (unsigned seed = 1; seed <= 24; ++seed) {
      BulletWorld<> w;
      w.add(shape, 0, btVector3(0, 0, 0));
      Random random(seed);
      btRigidBody& body = w.add(treeShape(plainTree(thrown.solid)), 1, btVector3(0, 0, 0), random.turn());
      moveTo(body,
             {random(-0.5, 1), random(-0.5, 1), random(0.1, 0.8) - lowest(body, thrown.solid, btVector3(0, 0, 1), 0)});
      body.setLinearVelocity({random(0, 4), random(0, 4), random(-2, 0)});
      body.setAngularVelocity(random.vector(3));
      w.step(420);
      ASSERT_TRUE(isSane(body)) << thrown.name << ", seed " << seed;
      const btScalar tolerance = bullet::kSpeculativeFraction;  // of about one metre
      EXPECT_GT(lowest(body, thrown.solid, btVector3(0, 0, 1), 0), -tolerance) << thrown.name << ", seed " << seed;
      EXPECT_GT(lowest(body, thrown.solid, btVector3(-1, 0, 0), -2), -tolerance) << thrown.name << ", seed " << seed;
      EXPECT_GT(lowest(body, thrown.solid, btVector3(0, -1, 0), -2), -tolerance) << thrown.name << ", seed " << seed;
    }
}

// Its centre of mass is below what it hangs by.
TEST(HangingByItsInside, ARingStaysOnItsPeg) {
  const Solid ring = torus(0.38, 0.12, 24);
  for (const btScalar half : {btScalar(0.05), btScalar(0.1)})
    for (const double speed : {0.0, 1.0, 2.0, 3.0})
      for (unsigned seed = 1; seed <= 6; ++seed) {
        BulletWorld<> w;
        w.add(meshOf(boxMesh({-half, -2, -2 * half}, {half, 2, 0}, 2)), 0, btVector3(0, 0, 0));
        Random random(seed);
        // The top of the hole stands over the peg, one step of falling above it.
        const btQuaternion upright(btVector3(1, 0, 0), SIMD_HALF_PI), aside(btVector3(0, 0, 1), random(-0.2, 0.2));
        btRigidBody& body =
            w.add(treeShape(plainTree(ring)), 1, btVector3(random(-0.01, 0.01), 0, btScalar(-0.26 + 0.03 + speed / 60)),
                  aside * upright);
        body.setLinearVelocity(btVector3(0, 0, btScalar(-speed)));
        w.step(180);
        ASSERT_TRUE(isSane(body));
        EXPECT_GT(body.getWorldTransform().getOrigin().z(), -0.5)
            << "peg of " << 2 * half << " m, " << speed << " m/s, seed " << seed;
      }
}

TEST(HangingByItsInside, TwoSlabsStayOnASheet) {
  std::vector<btVector3> sheet;
  addPatch(sheet, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 4);
  // Stands up, so that the slabs lie one above the other, and the sheet goes between them.
  const Solid slabs = twoCuboids({0.1, 0.7, 0.7}, {0.35, 0, 0}, 4);
  for (const double speed : {0.0, 1.0, 3.0})
    for (unsigned seed = 1; seed <= 6; ++seed) {
      BulletWorld<> w;
      w.add(meshOf(sheet), 0, btVector3(0, 0, 0));
      Random random(seed);
      const btQuaternion up(btVector3(0, 1, 0), SIMD_HALF_PI), aside(btVector3(0, 0, 1), random(0, 6));
      btRigidBody& body =
          w.add(treeShape(plainTree(slabs)), 1, btVector3(0, 0, btScalar(-0.125 + 0.004 + speed / 60)), aside * up);
      body.setLinearVelocity(btVector3(0, 0, btScalar(-speed)));
      w.step(180);
      ASSERT_TRUE(isSane(body));
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), -0.125, bullet::kSpeculativeFraction)
          << speed << " m/s, seed " << seed;
    }
}

// The sphere around a bowl turned over has its centre below the rim: it says nothing about which way is up.
TEST(OnAFineMesh, AHollowBodyStaysAboveAtSmallBudgets) {
  std::vector<btVector3> ground;
  addPatch(ground, {-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 60);
  const auto shape = meshOf(ground);
  const Solid solid = bowl(0.5, 0.42, 24);
  for (const std::int64_t operations : {200, 300})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      BulletWorld<> w;
      ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
      w.add(shape, 0, btVector3(0, 0, 0));
      Random random(seed);
      btRigidBody& body = w.add(treeShape(plainTree(solid)), 1, btVector3(0, 0, btScalar(0.8)), random.turn());
      body.setActivationState(DISABLE_DEACTIVATION);
      w.step(1200);
      ASSERT_TRUE(isSane(body));
      // Less than its wall is thick.
      EXPECT_GT(lowest(body, solid, btVector3(0, 0, 1), 0), -0.08) << operations << " operations, seed " << seed;
    }
}

// The guard of a whole body, whose centre has gone through the ground since, still pushes up.
TEST(TriangleSides, ABallIsWhereItWasSeen) {
  const auto tree = plainTree(cuboid({1, 1, 1}, 1), 100);
  const bullet::Triangle ground{{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}};
  bullet::TriangleSides sides;
  const auto touchAt = [&](double height) {
    const bullet::PlacedTree placed(*tree, {Mat3d(), {0, 0, height}, 1});
    return std::pair(placed, bullet::touchOf(placed, ground, {kRootNode, 0}));
  };
  sides.beginTraversal();
  const auto [below, fromBelow] = touchAt(-0.1);
  EXPECT_EQ(sides.ofBall(below, fromBelow), 1) << "nothing is known";
  const auto [above, fromAbove] = touchAt(0.1);
  sides.noteBall(fromAbove, fromAbove.line);
  EXPECT_EQ(sides.ofBall(above, fromAbove), 1);
  EXPECT_EQ(sides.ofBall(below, fromBelow), -1);
  sides.beginStep();
  sides.beginTraversal();
  EXPECT_EQ(sides.ofBall(below, fromBelow), -1);
  sides.reset();
  sides.beginTraversal();
  EXPECT_EQ(sides.ofBall(below, fromBelow), 1) << "forgotten";
}

TEST(TouchedSides, ASideHoldsForOneTraversalAndIsReplaced) {
  TouchedSides sides;
  const Vec3 up{0, 0, 1}, at;
  sides.beginTraversal();
  EXPECT_TRUE(sides.isFirst());
  sides.note(7, up, at);
  EXPECT_EQ(sides.ofNode(7, up), 0) << "before endNotes";
  sides.endNotes();
  EXPECT_EQ(sides.ofNode(7, up), 1);
  EXPECT_EQ(sides.ofNode(7, {0, 0.6F, -0.8F}), -1);
  EXPECT_EQ(sides.ofNode(7, {1, 0, 0}), 0);
  EXPECT_EQ(sides.ofNode(8, up), 0);
  sides.beginTraversal();
  EXPECT_FALSE(sides.isFirst());
  EXPECT_EQ(sides.ofNode(7, up), 1);
  sides.note(7, {0, 0.8F, 0.6F}, at);  // the same side, turned
  sides.endNotes();
  EXPECT_EQ(sides.ofNode(7, {0, 0.8F, -0.6F}), 0);
  EXPECT_EQ(sides.ofNode(7, {0, 0.8F, 0.6F}), 1);
  sides.beginTraversal();
  sides.beginTraversal();
  EXPECT_EQ(sides.ofNode(7, {0, 0.8F, 0.6F}), 0) << "not seen for a traversal";
}

TEST(TouchedSides, WhatOneNodeSawHoldsForAllInThatPlane) {
  TouchedSides sides;
  const Vec3 up{0, 0, 1};
  sides.beginTraversal();
  sides.note(7, up, {0, 0, 0});
  sides.endNotes();
  EXPECT_EQ(sides.ofTree(up, {5, 3, 0.01F}, 0.02F), 1);
  EXPECT_EQ(sides.ofTree(-up, {5, 3, 0.01F}, 0.02F), -1);
  EXPECT_EQ(sides.ofTree(up, {5, 3, 0.1F}, 0.02F), 0) << "another plane: the far side of something thin";
  EXPECT_EQ(sides.ofTree({0, 0.6F, 0.8F}, {0, 0, 0}, 0.02F), 0) << "37 degrees off";
  sides.note(9, -up, {1, 0, 0});
  sides.endNotes();
  EXPECT_EQ(sides.ofTree(up, {5, 3, 0}, 0.02F), 0) << "seen on both sides";
  sides.beginStep();
  sides.note(9, -up, {1, 0, 0});
  sides.endNotes();
  EXPECT_EQ(sides.ofTree(up, {5, 3, 0}, 0.02F), -1);
}

// Against Bullet's own integration of both bodies.
TEST(RelativeMotion, GoesBackToWhereTheLastStepWas) {
  const btScalar dt = btScalar(1) / 60;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    btTransform before[2], now[2];
    btVector3 linear[2], angular[2];
    for (int i = 0; i < 2; ++i) {
      before[i] = btTransform(random.turn(), random.vector(1));
      linear[i] = random.vector(20);
      angular[i] = random.vector(15);
      btTransformUtil::integrateTransform(before[i], linear[i], angular[i], dt, now[i]);
    }
    const auto vec = [](const btVector3& v) { return bullet::toVec3(v); };
    const RelativeMotion motion{vec(linear[0]),
                                vec(angular[0]),
                                vec(now[0].getOrigin()),
                                vec(linear[1]),
                                vec(angular[1]),
                                vec(now[1].getOrigin()),
                                float(dt),
                                1};
    const btVector3 inTree = random.vector(1);
    // Seen from the other body, then back into where that is now.
    const btVector3 expected = now[1] * (before[1].inverse() * (before[0] * inTree));
    const Vec3 found = motion.backOneStep() * vec(now[0] * inTree);
    EXPECT_LT(length(found - vec(expected)), 1e-5F) << "seed " << seed;  // single precision at lengths of a few metres
  }
}

}  // namespace
}  // namespace cairn::test
