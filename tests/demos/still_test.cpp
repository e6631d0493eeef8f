// SPDX-License-Identifier: GPL-3.0-or-later
// Flat bodies slide and stand as flat bodies do, and round ones roll.
#include <gtest/gtest.h>

#include <numbers>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "deepest_contact.h"
#include "distance_fields.h"
#include "still_scenes.h"

namespace cairn::test::still_test {
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
  const double angle = slope.degrees * std::numbers::pi / 180;
  return kGravity * (std::sin(angle) - double(slope.friction) * std::cos(angle));
}

TEST(Sliding, FollowsTheTextbookOnEveryGround) {
  const TriedBody block = bodyOf(cuboid({1, 0.3, 0.3}, 1)), slab = bodyOf(cuboid({12, 2, 0.4}, 1));
  const std::shared_ptr<btCollisionShape> grounds[] = {
      std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)),
      std::make_shared<btBoxShape>(btVector3(6, 1, btScalar(0.2))), slab.shape,
      fieldShape({{-6.5, -1.5, -0.6}, {6.5, 1.5, 0.6}, {27, 7, 5}}, boxDistance({6, 1, 0.2}))};
  for (const auto& ground : grounds)
    for (const double turned : {0.0, 0.7, std::numbers::pi / 2}) {
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

// A rolling body loses energy to the bumps of its facets; before the contacts knew that points move on arcs it lost a
// fifth.
TEST(Rolling, ABallOfFacetsLosesLittle) {
  constexpr double kRadius = 0.2, kLoss = 0.1;
  const TriedBody ball = bodyOf(test::ball(kRadius, 16));
  Slope slope;
  slope.ground = std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
  slope.height = btScalar(kRadius);
  slope.uphill = 4;
  slope.radius = kRadius;
  const double expected = kGravity * std::sin(slope.degrees * std::numbers::pi / 180) /
                          (1 + double(ball.inertia.x()) / (kRadius * kRadius));
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

// Bullet's solver leaves those of a manifold's points deepest that it asks first. Were they always the same, every cube
// would lean that way, and the stack would creep two to three times as far as one of boxes.
TEST(Standing, AStackCreepsNoFartherThanOneOfBoxes) {
  constexpr int kStacks = 5;
  const StackStart start{.seconds = 10, .iterations = 30, .edge = 1, .aside = btScalar(0.005)};
  const TriedBody cube = bodyOf(cuboid({1, 1, 1}, 1));
  const TriedBody box{std::make_shared<btBoxShape>(btVector3(0.5, 0.5, 0.5)), cube.inertia};
  const double ofTrees = quantile(runStacks(cube, start, kStacks), &StackRun::drift, 0.5);
  const double ofBoxes = quantile(runStacks(box, start, kStacks), &StackRun::drift, 0.5);
  EXPECT_LT(ofTrees, ofBoxes);
}

// Two faces at a shallow angle share a cluster of contacts: each must hold all the same.
TEST(Standing, ABoxAcrossAValleyLiesOnBothSlopes) {
  constexpr double kDegrees[] = {8, 15, 20};
  const TriedBody box = bodyOf(cuboid({0.8, 0.8, 0.3}, 4));
  for (const double degrees : kDegrees) {
    const TriedBody ground = bodyOf(valley(degrees, 1, 0.3, 3, 6));
    const double height = 0.15 + 0.4 * std::tan(degrees * std::numbers::pi / 180);
    StillWorld w;
    w.add(ground.shape, 0, btVector3(0, 0, 0));
    const btVector3 place(0, 0, btScalar(height));
    btRigidBody& body = w.addTried(box, btTransform(btQuaternion::getIdentity(), place), btScalar(0.5));
    w.step(3 * kStepsPerSecond);
    // Friction alone would hold it: nothing but a missing contact moves it by more than the speculative distance.
    const double allowed = double(bullet::kSpeculativeFraction) * std::sqrt(2 * 0.8 * 0.8 + 0.3 * 0.3);
    EXPECT_LT((body.getWorldTransform().getOrigin() - place).length(), allowed) << degrees << " degrees";
    EXPECT_LT(body.getWorldTransform().getRotation().getAngleShortestPath(), 0.005) << degrees << " degrees";
  }
}

// A smooth body touches an edge along no face's normal.
TEST(Standing, ABallLiesStillBetweenTwoEdges) {
  constexpr double kRadius = 0.3;
  const TriedBody ball = bodyOf(test::ball(kRadius, 16)), rail = bodyOf(cuboid({1, 3, 1}, 6));
  for (const double degrees : {30, 45, 60}) {
    StillWorld w;
    const double aside = kRadius * std::sin(degrees * std::numbers::pi / 180),
                 height = kRadius * std::cos(degrees * std::numbers::pi / 180);
    for (const double side : {-1.0, 1.0})
      w.add(rail.shape, 0, btVector3(btScalar(side * (0.5 + aside)), 0, btScalar(-0.5)));
    const btTransform start(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(height)));
    const btRigidBody& body = w.addTried(ball, start, btScalar(0.5));
    double farthest = 0;
    for (int i = 0; i < 4 * kStepsPerSecond; ++i) {
      w.step();
      const btVector3& at = body.getWorldTransform().getOrigin();
      farthest = std::max(farthest, std::hypot(double(at.x()), double(at.z()) - height));
    }
    // Along the edges it is free; across them the depth of contacts with its leaves is all that moves it.
    EXPECT_LT(farthest, 0.05 * kRadius) << degrees << " degrees";
  }
}

// Measured along the small body's face, nearly parallel to its own, a large leaf would be as deep as it is wide times
// the tilt.
TEST(Standing, ABlockHardlyTiltedIsAsFarAsItIs_WhicheverBodyIsFirst) {
  constexpr btScalar kAbove = 0.001F;
  constexpr double kDistanceTolerance = 5e-4;
  const Vec3d size(1, 0.4, 0.3);
  const TriedBody block = bodyOf(cuboid(size, 2)), slab = bodyOf(cuboid({16, 16, 1}, 8));
  for (const btScalar tilt : {0.005F, 0.02F, 0.04F, 0.052F})
    for (int place = 0; place < 8; ++place) {
      SCOPED_TRACE(std::to_string(tilt) + " rad at place " + std::to_string(place));
      BulletWorld<> w;
      btRigidBody& ground = w.add(slab.shape, 0, btVector3(0, 0, btScalar(-0.5)));
      const btQuaternion turn =
          btQuaternion(btVector3(0, 0, 1), btScalar(0.4 * place)) * btQuaternion(btVector3(1, 0.3F, 0), tilt);
      btScalar lowest = 0;
      for (int c = 0; c < 8; ++c) {
        const btVector3 corner(btScalar(c & 1 ? 0.5 : -0.5) * btScalar(size.x),
                               btScalar(c & 2 ? 0.5 : -0.5) * btScalar(size.y),
                               btScalar(c & 4 ? 0.5 : -0.5) * btScalar(size.z));
        lowest = std::min(lowest, quatRotate(turn, corner).z());
      }
      const btVector3 at(btScalar(1.3 * place - 5), btScalar(0.9 * place - 3), kAbove - lowest);
      btRigidBody& body = w.add(block.shape, 1, at, turn);
      for (const bullet::Finest finest : {bullet::Finest::leaves, bullet::Finest::triangles}) {
        w.dispatcher.setFinest(finest);
        DeepestContact bodyFirst, groundFirst;
        w.world.contactPairTest(&body, &ground, bodyFirst);
        w.world.contactPairTest(&ground, &body, groundFirst);
        EXPECT_NEAR(bodyFirst.separation, kAbove, kDistanceTolerance);
        EXPECT_NEAR(groundFirst.separation, kAbove, kDistanceTolerance);
      }
    }
}

}  // namespace
}  // namespace cairn::test::still_test
