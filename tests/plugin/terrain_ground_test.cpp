// SPDX-License-Identifier: Zlib
// Bodies on a terrain: they roll, slide and lie on it as on a plane, however it is cut into triangles; what has sunk
// comes up, and through holes bodies fall.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "still_scenes.h"
#include "terrains.h"

namespace cairn::test::terrain_ground_test {
namespace {

using bullet::TerrainDiagonals;
using bullet::TerrainShape;

struct Cut {
  TerrainDiagonals diagonals;
  double cell;
  double turned;  ///< degrees between the grid's x and the way down
};

// The middle of the grid is the middle of a cell in one, a point in the others.
constexpr Cut kEveryCut[] = {{TerrainDiagonals::alternating, 1, 0}, {TerrainDiagonals::rising, 1, 0},
                             {TerrainDiagonals::falling, 1, 0},     {TerrainDiagonals::alternating, 0.25, 0},
                             {TerrainDiagonals::rising, 0.7, 0},    {TerrainDiagonals::alternating, 1, 30},
                             {TerrainDiagonals::falling, 0.3, 77}};

std::shared_ptr<btCollisionShape> terrainCut(const Cut& cut) {
  const auto points = static_cast<std::uint32_t>(std::lround(40 / cut.cell));
  return flatTerrain(cut.diagonals, {points, points, cut.cell});
}

std::shared_ptr<btCollisionShape> plane() {
  return std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
}

constexpr double kBall = 0.2, kDiameter = 2 * kBall;
constexpr double kRollDegrees = 10;
constexpr int kRollSteps = 150;

struct Rolled {
  double speed = 0, aside = 0, hop = 0;
};

Rolled roll(const std::shared_ptr<btCollisionShape>& ball, std::shared_ptr<btCollisionShape> ground,
            double groundTurned, const btQuaternion& turned) {
  const btScalar moment = btScalar(0.4 * kBall * kBall);
  Slope slope{.degrees = kRollDegrees,
              .friction = 1,
              .ground = std::move(ground),
              .height = btScalar(kBall),
              .uphill = btScalar(3.1),
              .turned = turned,
              .radius = kBall};
  slope.groundTurned = btQuaternion(btVector3(0, 0, 1), btScalar(groundTurned * std::numbers::pi / 180));
  SlopeScene scene({ball, btVector3(moment, moment, moment)}, slope);
  Rolled rolled;
  for (int i = 0; i < kRollSteps; ++i) {
    scene.step(1);
    rolled.aside = std::max(rolled.aside, std::abs(scene.along(scene.way(), 1)));
    rolled.hop = std::max(rolled.hop, std::abs(scene.along(scene.way(), 2)));
  }
  rolled.speed = scene.along(scene.body().getLinearVelocity(), 0);
  return rolled;
}

// Mean of some differences, and its standard error.
struct Mean {
  explicit Mean(const std::vector<double>& all) {
    const auto count = static_cast<double>(all.size());
    double square = 0;
    for (const double one : all) value += one / count;
    for (const double one : all) square += (one - value) * (one - value) / (count - 1);
    error = std::sqrt(square / count);
  }
  double value = 0, error = 0;
};

// A faceted ball wanders, on a plane as well, and the least rounding decides where to: means of several starts are
// compared, and by how much they may differ by chance (twice the standard error) is granted. Tolerances are D10 of the
// hard cases.
TEST(OnTerrain, ATreeBallRollsAsOnAPlane) {
  constexpr int kStarts = 24;
  const auto ball = treeShape(plainTree(test::ball(kBall, 16)));
  std::vector<Rolled> onPlane;
  const auto turned = [](int start) { return btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.25 * start)); };
  for (int start = 0; start < kStarts; ++start) onPlane.push_back(roll(ball, plane(), 0, turned(start)));
  for (const Cut& cut : kEveryCut) {
    std::vector<double> speed, aside, hop;
    for (int start = 0; start < kStarts; ++start) {
      const Rolled one = roll(ball, terrainCut(cut), cut.turned, turned(start)), &plain = onPlane[std::size_t(start)];
      speed.push_back(one.speed / plain.speed - 1);
      aside.push_back((one.aside - plain.aside) / kDiameter);
      hop.push_back((one.hop - plain.hop) / kDiameter);
    }
    SCOPED_TRACE("cells of " + std::to_string(cut.cell) + ", turned by " + std::to_string(cut.turned));
    const Mean faster(speed), wider(aside), higher(hop);
    EXPECT_LT(std::abs(faster.value), 0.02);
    EXPECT_LT(wider.value, 0.01 + 2 * wider.error);
    EXPECT_LT(higher.value, 0.005);
    std::printf("speed %+.4f +- %.4f of that on a plane, aside %+.4f +- %.4f D, hop %+.4f D\n", faster.value,
                faster.error, wider.value, wider.error, higher.value);
  }
}

// Which way flat cells are cut is not felt at all: the same bits.
TEST(OnTerrain, FlatGroundIsTheSameHoweverItIsCut) {
  const auto ball = treeShape(plainTree(test::ball(kBall, 16)));
  const btQuaternion turned(btVector3(1, 2, 3).normalized(), btScalar(0.5));
  const Rolled first = roll(ball, terrainCut(kEveryCut[0]), 0, turned);
  for (const Cut& cut : kEveryCut) {
    if (cut.turned != 0 || cut.cell != kEveryCut[0].cell) continue;
    const Rolled other = roll(ball, terrainCut(cut), 0, turned);
    EXPECT_EQ(other.speed, first.speed) << cut.cell;
    EXPECT_EQ(other.aside, first.aside) << cut.cell;
  }
}

TEST(OnTerrain, ABoxSlidesAsMechanicsSays) {
  const double friction = 0.3, radians = std::numbers::pi / 6;
  const double theory = 9.81 * (std::sin(radians) - friction * std::cos(radians));
  const TriedBody box{treeShape(plainTree(cuboid({1, 0.4, 0.3}, 4))),
                      btVector3(btScalar(0.25 / 12), btScalar(1.09 / 12), btScalar(1.16 / 12))};
  for (const Cut& cut : kEveryCut)
    for (const bool bodyFirst : {false, true}) {
      Slope slope{.degrees = 30,
                  .friction = btScalar(friction),
                  .ground = terrainCut(cut),
                  .height = btScalar(0.15),
                  .uphill = 3};
      slope.groundTurned = btQuaternion(btVector3(0, 0, 1), btScalar(cut.turned * std::numbers::pi / 180));
      slope.bodyFirst = bodyFirst;
      const SlopeRun run = runSlope(box, slope);
      // As in the matrix of colliders: what mechanics and Bullet's friction cone agree to.
      EXPECT_NEAR(run.acceleration, theory, 0.02 * theory) << "cells of " << cut.cell << ", turned by " << cut.turned;
      EXPECT_NEAR(run.aside, 0, 0.01);
    }
}

std::shared_ptr<TerrainShape> roofTerrain(double slope) {
  bullet::TerrainGrid grid = terrainGrid({41, 41, 0.5}, [&](double x, double) { return -slope * std::abs(x - 10); });
  return terrainOf(std::move(grid));
}

btScalar heightAfter(const std::shared_ptr<btCollisionShape>& ground, const btVector3& from, bool upright, int steps) {
  BulletWorld<> w;
  w.add(ground, 0, btVector3(0, 0, 0));
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.3, 10))), 1, from);
  if (upright) {
    body.setLinearFactor(btVector3(0, 0, 1));
    body.setAngularFactor(btVector3(0, 0, 0));
  }
  w.step(steps);
  return body.getWorldTransform().getOrigin().z();
}

// The inscribed polyhedron is lower than the ball by at most the sagitta of a facet, which spans 9 degrees or less.
const double kSagitta = 0.3 * (1 - std::cos(0.08));
const double kRestTolerance = double(bullet::kSpeculativeFraction) * 0.6 * std::numbers::sqrt3;

TEST(OnTerrain, ABallRestsOnARidgeAndInAValley) {
  for (const double slope : {0.5, 1.0, 2.0}) {
    const double inValley = 0.3 * std::hypot(1, slope);
    EXPECT_NEAR(heightAfter(roofTerrain(slope), btVector3(0, 0, btScalar(0.5)), true, 240), 0.3,
                kRestTolerance + kSagitta);
    EXPECT_NEAR(heightAfter(roofTerrain(-slope), btVector3(0, 0, btScalar(inValley + 0.1)), false, 300), inValley,
                (kRestTolerance + kSagitta) * std::hypot(1, slope))
        << "slope " << slope;
  }
}

// Below the surface is inside, however deep: even where no part of the body reaches the surface any more.
TEST(OnTerrain, WhatHasSunkComesUp) {
  const auto ground = flatTerrain(TerrainDiagonals::alternating, {41, 41, 0.25});
  for (const double depth : {0.1, 0.3, 0.7}) {
    const btScalar height =
        heightAfter(ground, btVector3(btScalar(0.1), btScalar(0.05), btScalar(0.3 - depth)), false, 600);
    EXPECT_GT(height, 0.3 - kSagitta - kRestTolerance) << "sunk by " << depth;
  }
}

TEST(OnTerrain, BodiesFallThroughHolesAndOffTheBorder) {
  bullet::TerrainGrid grid = terrainGrid({21, 21, 0.5}, [](double x, double y) {
    return std::abs(x - 5) < 1.1 && std::abs(y - 5) < 1.1 ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  });
  const auto ground = terrainOf(std::move(grid));
  EXPECT_LT(heightAfter(ground, btVector3(0, 0, btScalar(0.4)), false, 120), -5) << "through the hole";
  EXPECT_LT(heightAfter(ground, btVector3(btScalar(5.5), 0, btScalar(0.4)), false, 120), -5) << "beside the terrain";
  EXPECT_NEAR(heightAfter(ground, btVector3(3, 0, btScalar(0.4)), false, 120), 0.3, kRestTolerance + kSagitta);
}

// Ten kilometres of terrain: at its far corner a ball rests as in its middle, to the precision of coordinates there.
TEST(OnTerrain, RestsFarFromTheMiddle) {
  const auto ground = terrainOf(terrainGrid({1001, 1001, 10}, [](double, double) { return 0; }));
  const double ulp = 4990 * double(SIMD_EPSILON);
  for (const double at : {0.0, 4990.0})
    EXPECT_NEAR(heightAfter(ground, btVector3(btScalar(at), btScalar(at), btScalar(0.4)), false, 200), 0.3,
                kRestTolerance + kSagitta + 4 * ulp);
}

// Through a sheet at a metre and more a step.
TEST(OnTerrain, HoldsFastBodies) {
  std::mt19937_64 engine(50);
  const auto ground = terrainOf(randomTerrain(engine, {61, 61, 0.5}));
  int through = 0;
  for (int trial = 0; trial < 40; ++trial) {
    BulletWorld<> w;
    w.add(ground, 0, btVector3(0, 0, 0));
    const btScalar top = ground->upper().z() + btScalar(uniform(engine, 1, 3));
    btRigidBody& body = w.add(treeShape(plainTree(ball(0.3, 6))), 1,
                              btVector3(btScalar(uniform(engine, -5, 5)), btScalar(uniform(engine, -5, 5)), top));
    body.setCcdMotionThreshold(btScalar(0.1));
    body.setLinearVelocity(btVector3(btScalar(uniform(engine, -20, 20)), 0, btScalar(-uniform(engine, 60, 200))));
    w.step(30);
    const btVector3& p = body.getWorldTransform().getOrigin();
    const auto height = ground->heightAt(double(p.x()), double(p.y()));
    if (height && double(p.z()) < *height) ++through;
  }
  EXPECT_EQ(through, 0);
}

TEST(OnTerrain, ContactsNameTheTriangle) {
  BulletWorld<> w;
  const auto ground = flatTerrain(TerrainDiagonals::rising, {11, 11, 1});
  w.add(ground, 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(ball(0.3, 10))), 1, btVector3(btScalar(1.7), btScalar(-2.2), btScalar(0.3)));
  w.step(10);
  ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
  const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(0);
  ASSERT_GT(manifold.getNumContacts(), 0);
  const bool isFirst = bullet::asTerrain(manifold.getBody0()->getCollisionShape()) != nullptr;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const bullet::TerrainTriangle t =
        bullet::terrainTriangle(ground->grid(), isFirst ? point.m_index0 : point.m_index1);
    EXPECT_EQ(t.column, 6);
    EXPECT_EQ(t.row, 2);
    EXPECT_EQ(t.isUpper, point.m_positionWorldOnA.y() + 3 > point.m_positionWorldOnA.x() - 1);
  }
}

}  // namespace
}  // namespace cairn::test::terrain_ground_test
