// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere-tree against everything Bullet has, in both roles and both orders: bodies rest, slide and roll as mechanics
// says. `./cairn.sh bench matrix` prints the same beside Bullet's own shapes.
#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "counterpart_trials.h"

namespace cairn::test {
namespace {

std::shared_ptr<const SphereTree> builtTree(const Solid& solid) {
  builder::TriangleMesh mesh = meshOf(solid);
  mesh.name = "generated";
  return std::make_shared<const SphereTree>(builder::buildTree(mesh, {}).value());
}

constexpr double kSlideTolerance = 0.02;  // of the acceleration: what mechanics and Bullet's friction cone agree to
// Of a smooth body's: within a step it rolls by a tenth of its radius, and the solver moves it straight on. Bullet's
// own capsules and cylinders are up to 19 % off at this rate.
constexpr double kRollTolerance = 0.05;
constexpr double kRestSpeed = 0.01;  // m/s

void expectRest(const TriedGround& ground, const TriedMover& mover, double size, bool bodyFirst) {
  const RestRun run = Trials::rest(ground, mover, bodyFirst);
  EXPECT_NEAR(run.height, Trials::restTheory(ground, mover), double(bullet::kSpeculativeFraction) * size);
  EXPECT_LT(run.speed, kRestSpeed);
  EXPECT_GT(run.upright, 0.999);
  EXPECT_GT(run.touching.contacts, 0);
}

void expectSlide(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
  const double theory = Trials::slideTheory(ground, mover);
  EXPECT_NEAR(Trials::slide(ground, mover, bodyFirst).acceleration, theory, kSlideTolerance * theory);
}

void expectRoll(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
  const double theory = Trials::rollTheory(ground, mover);
  const double acceleration = Trials::roll(ground, mover, bodyFirst).acceleration;
  EXPECT_LT(acceleration, theory * (1 + kRollTolerance));
  EXPECT_GT(acceleration, theory * (1 - kRollTolerance) - Trials::facetLoss(mover, theory));
}

double sizeOf(const TriedMover& mover) {
  btVector3 lower, upper;
  mover.body.shape->getAabb(btTransform::getIdentity(), lower, upper);
  return double((upper - lower).length());
}

TEST(CounterpartMatrix, ATreeLiesOnEverything) {
  const TriedMover block = treeBlock(builtTree), ball = treeBall(builtTree);
  for (const TriedGround& ground : everyGround(builtTree))
    for (const bool bodyFirst : {false, true}) {
      SCOPED_TRACE("on " + ground.name + (bodyFirst ? ", added before it" : ""));
      expectRest(ground, block, sizeOf(block), bodyFirst);
      expectSlide(ground, block, bodyFirst);
      expectRoll(ground, ball, bodyFirst);
    }
}

TEST(CounterpartMatrix, EverythingLiesOnATree) {
  const std::vector<TriedGround> grounds = everyGround(builtTree);
  const TriedGround& slab = *std::ranges::find(grounds, "tree", &TriedGround::name);
  for (const TriedMover& mover : everyMover(builtTree))
    for (const bool bodyFirst : {false, true}) {
      SCOPED_TRACE(mover.name + " on a tree" + (bodyFirst ? ", added before it" : ""));
      expectRest(slab, mover, sizeOf(mover), bodyFirst);
      if (mover.radius > 0)
        expectRoll(slab, mover, bodyFirst);
      else
        expectSlide(slab, mover, bodyFirst);
    }
}

}  // namespace
}  // namespace cairn::test
