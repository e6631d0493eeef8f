// SPDX-License-Identifier: GPL-3.0-or-later
// A sphere-tree against everything Bullet has, in both roles and both orders: bodies rest, slide and roll as mechanics
// says. `./cairn.sh bench matrix` prints the same beside Bullet's own shapes.
#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "collider_trials.h"

namespace cairn::test::collider_matrix_test {
namespace {

std::shared_ptr<const SphereTree> builtTree(const Solid& solid) {
  builder::TriangleMesh mesh = meshOf(solid);
  mesh.name = "generated";
  return std::make_shared<const SphereTree>(builder::buildTree(mesh, {}).value());
}

constexpr double kSlideTolerance = 0.02;  // of the acceleration: what mechanics and Bullet's friction cone agree to
// Where a block slides along the seams of a compound, each child has points of its own there.
constexpr double kSeamTolerance = 0.06;
// A round base is asked at eight points of its border.
constexpr double kRoundBaseTolerance = 0.03;
// Of a smooth body's: within a step it rolls by a tenth of its radius, and the solver moves it straight on.
constexpr double kRollTolerance = 0.05;
constexpr double kRestSpeed = 0.01;  // m/s
// A flat body rocks for a while on a curved one.
constexpr double kRockingSpeed = 0.06;

double sizeOf(const TriedMover& mover) {
  btVector3 lower, upper;
  mover.body.shape->getAabb(btTransform::getIdentity(), lower, upper);
  return double((upper - lower).length());
}

void expectRest(const TriedGround& ground, const TriedMover& mover, double stockSpeed, bool bodyFirst) {
  const RestRun run = Trials::rest(ground, mover, bodyFirst);
  EXPECT_NEAR(run.height, Trials::restTheory(ground, mover), double(bullet::kSpeculativeFraction) * sizeOf(mover));
  EXPECT_LT(run.speed, std::max(ground.bend > 0 ? kRockingSpeed : kRestSpeed, stockSpeed));
  EXPECT_GT(run.upright, 0.999);
  EXPECT_GT(run.touching.contacts, 0);
}

void expectSlide(const TriedGround& ground, const TriedMover& mover, double tolerance, bool bodyFirst) {
  const double theory = Trials::slideTheory(ground, mover);
  EXPECT_NEAR(Trials::slide(ground, mover, bodyFirst).acceleration, theory, tolerance * theory);
}

// Within the tolerance, or as near as Bullet's own shape beside it, whose capsules and cylinders are up to 19 % off.
void expectRoll(const TriedGround& ground, const TriedMover& mover, double stockOff, bool bodyFirst) {
  const double theory = Trials::rollTheory(ground, mover), tolerance = std::max(kRollTolerance, stockOff);
  const double acceleration = Trials::roll(ground, mover, bodyFirst).acceleration;
  EXPECT_LT(acceleration, theory * (1 + tolerance));
  EXPECT_GT(acceleration, theory * (1 - tolerance) - Trials::facetLoss(mover, theory));
}

double rollsOff(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
  return std::abs(Trials::roll(ground, mover, bodyFirst).acceleration / Trials::rollTheory(ground, mover) - 1);
}

bool isRoundBased(const TriedMover& mover) {
  return mover.name.ends_with("standing");
}

TEST(ColliderMatrix, ATreeLiesOnEverything) {
  const TriedMover block = treeBlock(builtTree), ball = treeBall(builtTree);
  for (const TriedGround& ground : everyGround(builtTree))
    for (const bool bodyFirst : {false, true}) {
      SCOPED_TRACE("on " + ground.name + (bodyFirst ? ", added before it" : ""));
      expectRest(ground, block, 0, bodyFirst);
      expectSlide(ground, block, ground.name == "compound" ? kSeamTolerance : kSlideTolerance, bodyFirst);
      expectRoll(ground, ball, 0, bodyFirst);
    }
}

TEST(ColliderMatrix, EverythingLiesOnATree) {
  const std::vector<TriedGround> grounds = everyGround(builtTree);
  const TriedGround& slab = *std::ranges::find(grounds, "tree", &TriedGround::name);
  for (const TriedMover& mover : everyMover(builtTree)) {
    for (const bool bodyFirst : {false, true}) {
      SCOPED_TRACE(mover.name + " on a tree" + (bodyFirst ? ", added before it" : ""));
      // Bullet's cone sways on its own box by 7 cm/s.
      if (mover.facets == 0) expectRest(slab, mover, Trials::rest(boxGround(), mover, bodyFirst).speed, bodyFirst);
      if (mover.radius > 0)
        expectRoll(slab, mover, rollsOff(boxGround(), mover, bodyFirst), bodyFirst);
      else
        expectSlide(slab, mover, isRoundBased(mover) ? kRoundBaseTolerance : kSlideTolerance, bodyFirst);
    }
  }
}

}  // namespace
}  // namespace cairn::test::collider_matrix_test
