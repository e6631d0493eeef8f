// SPDX-License-Identifier: Zlib
// Bullet's convex shapes in holes of a tree that leave them a little play.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "bullet_world.h"
#include "extruded.h"

namespace cairn::test::convex_fits_test {
namespace {

constexpr double kG = 10;
constexpr btScalar kRadius = btScalar(0.2), kHalfLength = btScalar(0.4);

std::shared_ptr<btConvexHullShape> hullOf(const Solid& solid) {
  auto hull = std::make_shared<btConvexHullShape>();
  hull->setMargin(btScalar(1e-4));
  for (const Vec3d& v : solid.vertices) hull->addPoint(btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)), false);
  hull->recalcLocalAabb();
  return hull;
}

enum class Piece { ball, capsule, cylinder, box, hull };
const char* name(Piece piece) {
  return std::array{"Ball", "Capsule", "Cylinder", "Box", "Hull"}[static_cast<std::size_t>(piece)];
}

std::shared_ptr<btCollisionShape> shapeOf(Piece piece) {
  switch (piece) {
    case Piece::ball:
      return std::make_shared<btSphereShape>(kRadius);
    case Piece::capsule:
      return std::make_shared<btCapsuleShapeZ>(kRadius, 2 * (kHalfLength - kRadius));
    case Piece::cylinder:
      return std::make_shared<btCylinderShapeZ>(btVector3(kRadius, kRadius, kHalfLength));
    case Piece::box:
      return std::make_shared<btBoxShape>(btVector3(kRadius, kRadius, kHalfLength));
    case Piece::hull:
      return hullOf(extruded(circle(kRadius, 32), -kHalfLength, kHalfLength));
  }
  return nullptr;
}

class ConvexFits : public testing::TestWithParam<Piece> {};
INSTANTIATE_TEST_SUITE_P(Pieces, ConvexFits,
                         testing::Values(Piece::ball, Piece::capsule, Piece::cylinder, Piece::box, Piece::hull),
                         [](const auto& piece) { return name(piece.param); });

TEST_P(ConvexFits, FallsIntoItsHole) {
  for (const double play : {0.01, 0.05})
    for (int start = 0; start < 4; ++start) {
      BulletWorld<> w;
      w.world.setGravity(btVector3(0, 0, btScalar(-kG)));
      const double hole = double(kRadius) * (1 + play);
      const auto block = GetParam() == Piece::box ? holedBlock(0.5, hole * std::sqrt(2), 4, -0.3, 0.3)
                                                  : holedBlock(0.5, hole, 32, -0.3, 0.3);
      w.add(treeShape(plainTree(block, 4)), 0, btVector3(0, 0, 0)).setFriction(1);
      const double angle = start * 1.7, off = 0.0005 * start, tilt = 0.0012 * start;
      btQuaternion turn(btVector3(btScalar(std::cos(angle)), btScalar(std::sin(angle)), 0), btScalar(tilt));
      if (GetParam() == Piece::box) turn = turn * btQuaternion(btVector3(0, 0, 1), btScalar(std::numbers::pi / 4));
      btRigidBody& piece =
          w.add(shapeOf(GetParam()), 1,
                btVector3(btScalar(off * std::cos(angle)), btScalar(off * std::sin(angle)), btScalar(0.72)), turn);
      piece.setFriction(btScalar(0.1));
      btScalar aside = 0;
      for (int step = 0; step < 60 && piece.getWorldTransform().getOrigin().z() > 0; ++step) {
        w.step();
        aside = std::max({aside, std::abs(piece.getLinearVelocity().x()), std::abs(piece.getLinearVelocity().y())});
      }
      EXPECT_LT(piece.getWorldTransform().getOrigin().z(), 0) << "play " << play << ", start " << start;
      EXPECT_LT(aside, 0.05) << "pushed aside, play " << play << ", start " << start;
    }
}

// Its middle already inside: it goes out the nearest way, whatever the surface around it would say.
TEST(ConvexDeep, GoesOutTheNearestWay) {
  for (const Piece piece : {Piece::ball, Piece::capsule, Piece::cylinder, Piece::box, Piece::hull})
    for (const btScalar height : {btScalar(-0.02), btScalar(-0.1)}) {
      BulletWorld<> w;
      w.add(treeShape(plainTree(cuboid({6, 6, 2}, 4))), 0, btVector3(0, 0, -1));
      btRigidBody& body = w.add(shapeOf(piece), 1, btVector3(btScalar(0.1), btScalar(0.2), height));
      body.setActivationState(DISABLE_DEACTIVATION);
      btScalar fastest = 0;
      for (int step = 0; step < 180; ++step) {
        w.step();
        fastest = std::max(fastest, body.getLinearVelocity().length());
      }
      const double lowest = piece == Piece::ball ? double(kRadius) : double(kHalfLength);
      EXPECT_GT(double(body.getWorldTransform().getOrigin().z()), double(kRadius) - 0.01)
          << name(piece) << " " << height;
      EXPECT_LT(double(body.getWorldTransform().getOrigin().z()), lowest + 0.01) << name(piece) << " " << height;
      EXPECT_LT(fastest, 1) << name(piece) << " is thrown, " << height;
    }
}

// A corner that is deep in a floor and in a wall is over neither, and comes out of both.
TEST(ConvexDeep, StaysOnTheFloorThatItIsThrownAlong) {
  const Outline floorAndWall{{-2, -1}, {2, -1}, {2, 2}, {1, 2}, {1, 0}, {-2, 0}};
  BulletWorld<> w;
  const btQuaternion up(btVector3(1, 0, 0), btScalar(std::numbers::pi / 2));
  w.add(treeShape(plainTree(extruded(floorAndWall, -2, 2))), 0, btVector3(0, 0, 0), up);
  btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1) / 4), 1, btVector3(0, 0, btScalar(0.3)));
  box.setLinearVelocity(btVector3(6, 0, 0));
  for (int step = 0; step < 60; ++step) {
    box.applyCentralForce(btVector3(20, 0, 0));
    w.step();
    EXPECT_LT(box.getLinearVelocity().z(), 0.5) << "step " << step;
  }
}

// A pair at rest is reused without being asked, but not after the user gives it another size.
TEST(ConvexCarriedOver, IsAskedAnewOnceItHasChanged) {
  for (const bool isHull : {false, true}) {
    BulletWorld<> w;
    w.add(treeShape(plainTree(cuboid({4, 4, 1}, 4))), 0, btVector3(0, 0, btScalar(-0.5)));
    const std::shared_ptr<btCollisionShape> box =
        isHull ? std::static_pointer_cast<btCollisionShape>(hullOf(cuboid({1, 1, 1}, 1)))
               : std::make_shared<btBoxShape>(btVector3(1, 1, 1) / 2);
    btRigidBody& body = w.add(box, 1, btVector3(0, 0, btScalar(0.5)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(120);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, 0.002);
    box->setLocalScaling(btVector3(1, 1, 2));
    w.step(240);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 1, 0.004) << (isHull ? "hull" : "box");
  }
}

}  // namespace
}  // namespace cairn::test::convex_fits_test
