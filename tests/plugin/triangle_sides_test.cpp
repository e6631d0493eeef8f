// SPDX-License-Identifier: Zlib
// A triangle has no inside: on which side of it a body belongs is told from where the body was, what it faces and where
// the rest of it is.
#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"
#include "placement/bullet_math.h"
#include "triangle_grounds.h"
#include "triangles/side_history.h"
#include "triangles/triangle_sides.h"

namespace cairn::test::triangle_sides_test {
namespace {

using bullet::SideHistory;

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

// A cube of 1 m over or under a large triangle at height 0, met step by step.
class TriangleSidesStep : public testing::Test {
 protected:
  void step(double height, double speed = 0) {
    placement_.tree = bullet::PlacedTree(*tree_, {Mat3d(), {}, 1});
    placement_.treeBody = btTransform::getIdentity();
    placement_.other = btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(-height)));
    placement_.travel = float(speed / 60);
    const auto down = float(-height);
    ground_ = {{-5, -5, down}, {5, -5, down}, {0, 5, down}};
    sides_.beginStep(placement_);
    sides_.beginTraversal();
  }
  int side() {
    const std::vector touches{touchOf(placement_.tree, ground_, {kRootNode, 0})};
    return sides_.settle(placement_.tree, std::span(&ground_, 1), touches, true)[0];
  }
  int ballSide() { return sides_.ofBall(placement_.tree, touchOf(placement_.tree, ground_, {kRootNode, 0})); }
  void noteBall() {
    const bullet::TriangleTouch touch = touchOf(placement_.tree, ground_, {kRootNode, 0});
    sides_.noteBall(touch, touch.line);
  }

  bullet::TriangleSides sides_;

 private:
  std::shared_ptr<const SphereTree> tree_ = plainTree(cuboid({1, 1, 1}, 1), 100);
  bullet::PairPlacement placement_;
  bullet::Triangle ground_;
};

TEST_F(TriangleSidesStep, WhatWasSeenAboveHasSunk) {
  step(0.1);
  EXPECT_EQ(side(), 1);
  step(-0.05);
  EXPECT_EQ(side(), -1);
  step(-0.1);
  EXPECT_EQ(side(), -1);
  step(0.1);
  EXPECT_EQ(side(), 1);
}

TEST_F(TriangleSidesStep, WhatWentThroughSinceTheLastStepHasSunk) {
  step(0.6);  // not near enough to be asked about
  step(-0.1, 42);
  EXPECT_EQ(side(), -1);
}

TEST_F(TriangleSidesStep, WhatWasSetDownElsewhereHasNoPast) {
  step(0.5);
  EXPECT_EQ(side(), 1);
  step(-0.5);  // at rest, and twice half its radius farther
  EXPECT_EQ(side(), 1);
  // However fast it is said to move there: it has never been on the other side.
  step(2);
  step(0.1, 30);
  EXPECT_EQ(side(), 1);
}

TEST_F(TriangleSidesStep, ABallIsWhereItWasSeen) {
  step(-0.1);
  EXPECT_EQ(ballSide(), 1) << "nothing is known";
  step(0.1);
  noteBall();
  EXPECT_EQ(ballSide(), 1);
  step(-0.1);
  EXPECT_EQ(ballSide(), 1) << "the centre of mass has gone through with it";
}

// The guard of a whole cup turned over, whose ball's centre has gone through the ground, still pushes up.
TEST(TriangleSides, ABallIsWhereItWasNotedWithTheCenterOfMass) {
  const auto tree = plainTree(revolved({{0, -0.5}, {0.3, -0.5}, {0.3, 0}, {0.25, 0}, {0.25, -0.3}, {0, -0.3}}, 24));
  const float toBall = tree->sphere(kRootNode).center.z;  // from the centre of mass, towards the rim
  ASSERT_GT(toBall, 0.02F);
  bullet::PairPlacement placement;
  placement.treeBody = btTransform(btQuaternion(btVector3(1, 0, 0), SIMD_PI));
  placement.travel = 0.1F;
  bullet::TriangleSides sides;
  const auto ballSide = [&](float height, bool isNoted) {
    placement.tree = bullet::PlacedTree(*tree, {bullet::toMat3d(placement.treeBody.getBasis()), {}, 1});
    const float ground = -toBall - height;  // the ball's centre is this high above it
    placement.other = btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(ground)));
    const bullet::Triangle triangle{{-5, -5, ground}, {5, -5, ground}, {0, 5, ground}};
    sides.beginStep(placement);
    sides.beginTraversal();
    const bullet::TriangleTouch touch = touchOf(placement.tree, triangle, {kRootNode, 0});
    if (isNoted) sides.noteBall(touch, touch.line);
    return sides.ofBall(placement.tree, touch);
  };
  EXPECT_EQ(ballSide(-0.01F, false), 1) << "nothing is known";
  EXPECT_EQ(ballSide(0.01F, true), 1);
  EXPECT_EQ(ballSide(-0.01F, false), -1);
  EXPECT_EQ(ballSide(-toBall - 0.01F, false), 1) << "the centre of mass has gone through as well";
}

constexpr Vec3 kUp{0, 0, 1};
constexpr float kTolerance = 0.02F;

TEST(SideHistory, ASideHoldsForOneTraversalAndIsReplaced) {
  SideHistory sides;
  const auto sideOf = [&](NodeId node, const Vec3& normal) { return sides.ofNode(node, {{}, normal}, kTolerance); };
  sides.beginTraversal();
  EXPECT_TRUE(sides.isFirst());
  sides.note(7, {{}, kUp});
  EXPECT_EQ(sideOf(7, kUp), 0) << "before endNotes";
  sides.endNotes();
  EXPECT_EQ(sideOf(7, kUp), 1);
  EXPECT_EQ(sideOf(7, {0, 0.6F, -0.8F}), -1);
  EXPECT_EQ(sideOf(7, {1, 0, 0}), 0);
  EXPECT_EQ(sideOf(8, kUp), 0);
  sides.beginTraversal();
  EXPECT_FALSE(sides.isFirst());
  EXPECT_EQ(sideOf(7, kUp), 1);
  sides.note(7, {{}, {0, 0.8F, 0.6F}});  // the same side, turned
  sides.endNotes();
  EXPECT_EQ(sideOf(7, {0, 0.8F, -0.6F}), 0);
  EXPECT_EQ(sideOf(7, {0, 0.8F, 0.6F}), 1);
  EXPECT_TRUE(sides.isBehind(7, {0, -0.1F, 0}));
  EXPECT_FALSE(sides.isBehind(7, {0, 0.1F, 0}));
  EXPECT_FALSE(sides.isBehind(8, {0, -0.1F, 0}));
  sides.beginTraversal();
  sides.beginTraversal();
  EXPECT_EQ(sideOf(7, {0, 0.8F, 0.6F}), 0) << "not seen for a traversal";
}

TEST(SideHistory, AFloorBelowACeilingIsAnotherSurface) {
  SideHistory sides;
  sides.beginTraversal();
  sides.note(7, {{0, 0, 0.1F}, -kUp});
  sides.endNotes();
  EXPECT_EQ(sides.ofNode(7, {{0, 0, 0}, kUp}, kTolerance), 0);
  EXPECT_EQ(sides.ofNode(7, {{0, 0, 0.09F}, kUp}, kTolerance), -1) << "the ceiling itself, from above";
  EXPECT_EQ(sides.ofNode(7, {{0.3F, 0, 0.05F}, kUp}, kTolerance), -1) << "the ceiling itself, aside and bent";
  EXPECT_EQ(sides.ofNode(7, {{0, 0, 0.3F}, kUp}, kTolerance), -1) << "the top of what the ceiling is the bottom of";
}

TEST(SideHistory, SidesMoveWithTheSurface) {
  SideHistory sides;
  sides.beginTraversal();
  sides.note(7, {{0, 0, 0.1F}, -kUp});
  sides.endNotes();
  sides.beginStep([](bullet::SurfaceSide& s) {
    s.point = {s.point.z, s.point.y, -s.point.x};  // a quarter turn about y
    s.normal = {s.normal.z, s.normal.y, -s.normal.x};
  });
  EXPECT_EQ(sides.ofNode(7, {{0.1F, 0, 0}, {-1, 0, 0}}, kTolerance), 1);
  EXPECT_EQ(sides.ofNode(7, {{0.1F, 0, 0}, kUp}, kTolerance), 0);
}

TEST(SideHistory, WhatOneNodeSawHoldsForAllInThatPlane) {
  SideHistory sides;
  const auto still = [](bullet::SurfaceSide&) {};
  const auto sideOf = [&](const Vec3& normal, const Vec3& at) { return sides.ofTree({at, normal}, kTolerance); };
  sides.beginTraversal();
  sides.note(7, {{}, kUp});
  sides.endNotes();
  EXPECT_EQ(sideOf(kUp, {5, 3, 0.01F}), 1);
  EXPECT_EQ(sideOf(-kUp, {5, 3, 0.01F}), -1);
  EXPECT_EQ(sideOf(kUp, {5, 3, 0.1F}), 0) << "another plane: the far side of something thin";
  EXPECT_EQ(sideOf({0, 0.6F, 0.8F}, {}), 0) << "37 degrees off";
  sides.note(9, {{1, 0, 0}, -kUp});
  sides.endNotes();
  EXPECT_EQ(sideOf(kUp, {5, 3, 0}), 0) << "seen on both sides";
  sides.beginStep(still);
  EXPECT_EQ(sideOf(kUp, {5, 3, 0}), 0) << "nothing seen in this step";
  sides.note(9, {{1, 0, 0}, -kUp});
  sides.endNotes();
  EXPECT_EQ(sideOf(kUp, {5, 3, 0}), -1);
}

TEST(SideHistory, AThirdIsOutvoted) {
  SideHistory sides;
  const auto still = [](bullet::SurfaceSide&) {};
  sides.beginTraversal();
  EXPECT_FALSE(sides.isOutvoted(kUp)) << "nothing was seen";
  for (NodeId node = 0; node < 4; ++node) sides.note(node, {{}, node == 0 ? -kUp : kUp});
  sides.endNotes();
  EXPECT_FALSE(sides.isOutvoted(-kUp)) << "not in the step in which it is seen";
  sides.beginStep(still);
  EXPECT_TRUE(sides.isOutvoted(-kUp));
  EXPECT_FALSE(sides.isOutvoted(kUp));
  sides.note(1, {{}, -kUp});  // a node on both sides
  sides.endNotes();
  sides.beginStep(still);
  EXPECT_FALSE(sides.isOutvoted(-kUp)) << "three against two";
}

}  // namespace
}  // namespace cairn::test::triangle_sides_test
