// SPDX-License-Identifier: GPL-3.0-or-later
// Flat bodies slide and stand as flat bodies do, and round ones roll.
#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "still_scenes.h"

namespace cairn::test {
namespace {

// As a tree that `cairn build` makes, smaller: what is fitted takes half a second.
TriedBody bodyOf(const Solid& solid) {
  builder::BuildOptions options;
  options.samples = 2000;
  auto tree = builder::buildTree(meshOf(solid), options);
  EXPECT_TRUE(tree) << tree.error().message;
  const auto shape = treeShape(std::make_shared<const SphereTree>(std::move(tree).value()));
  btVector3 inertia;
  shape->calculateLocalInertia(1, inertia);
  return {shape, inertia};
}

constexpr double kGravity = 9.81;

double slidingDown(const Slope& slope) {
  const double angle = slope.degrees * M_PI / 180;
  return kGravity * (std::sin(angle) - double(slope.friction) * std::cos(angle));
}

TEST(Sliding, FollowsTheTextbookOnEveryGround) {
  const TriedBody block = bodyOf(cuboid({1, 0.3, 0.3}, 1)), slab = bodyOf(cuboid({12, 2, 0.4}, 1));
  const std::shared_ptr<btCollisionShape> grounds[] = {
      std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)),
      std::make_shared<btBoxShape>(btVector3(6, 1, btScalar(0.2))), slab.shape};
  for (const auto& ground : grounds)
    for (const double turned : {0.0, 0.7, M_PI / 2}) {
      Slope slope;
      slope.degrees = 30;
      slope.friction = btScalar(0.3);
      slope.ground = ground;
      slope.top = ground->getShapeType() == STATIC_PLANE_PROXYTYPE ? btScalar(0) : btScalar(0.2);
      slope.height = btScalar(0.15);
      slope.uphill = 4;
      slope.turned = btQuaternion(btVector3(0, 0, 1), btScalar(turned));
      const SlopeRun run = runSlope(block, slope);
      EXPECT_NEAR(run.acceleration, slidingDown(slope), 0.02 * slidingDown(slope))
          << "on " << ground->getName() << ", turned by " << turned;
      EXPECT_LT(std::abs(run.aside), 0.01);
    }
}

// A leaf of the edge belongs to two faces: its centre says nothing about which of them touches.
TEST(Sliding, LeavesOverAnEdgeDoNotCatch) {
  const TriedBody cube = bodyOf(cuboid({1, 1, 1}, 1));
  Slope slope;
  slope.degrees = 30;
  slope.friction = btScalar(0.3);
  slope.ground = cube.shape;
  slope.top = slope.height = btScalar(0.5);
  slope.uphill = btScalar(0.3);
  slope.fromStep = 6;
  slope.toStep = 36;
  EXPECT_NEAR(runSlope(cube, slope).acceleration, slidingDown(slope), 0.02 * slidingDown(slope));
}

// What rolls loses to the bumps of its facets; before the contacts knew that points move on arcs it lost a fifth.
TEST(Rolling, ABallOfFacetsLosesLittle) {
  constexpr double kRadius = 0.2, kLoss = 0.1;
  const TriedBody ball = bodyOf(test::ball(kRadius, 16));
  Slope slope;
  slope.ground = std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
  slope.height = btScalar(kRadius);
  slope.uphill = 4;
  slope.radius = kRadius;
  const double expected =
      kGravity * std::sin(slope.degrees * M_PI / 180) / (1 + double(ball.inertia.x()) / (kRadius * kRadius));
  const SlopeRun run = runSlope(ball, slope);
  EXPECT_NEAR(run.acceleration, expected, kLoss * expected);
}

TEST(Standing, CubesOfTreesDoNotFloatOnEachOther) {
  const TriedBody cube = bodyOf(cuboid({1, 1, 1}, 1));
  const StackRun run = runStack(cube, {.cubes = 4, .seconds = 4, .iterations = 30, .edge = 1});
  // Up by the speculative distance of each contact at most; down by what the solver leaves.
  EXPECT_GT(run.settling, -4 * double(bullet::kSpeculativeFraction) * std::sqrt(3.0));
  EXPECT_LT(run.settling, 0.01);
  EXPECT_LT(run.drift, 0.05);
}

}  // namespace
}  // namespace cairn::test
