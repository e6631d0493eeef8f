// SPDX-License-Identifier: Zlib
// A body at rest stays at rest when its budget is cut at random in every step; what answers meanwhile decides.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test::cut_budget_test {
namespace {

using bullet::Unresolved;

constexpr unsigned kSeed = 6;
constexpr int kSettling = 300, kWatched = 300;

struct Unrest {
  double rmsSpeed = 0;     // metres per second
  double rmsPosition = 0;  // about the mean, of the body's size
};

// A body on a plane keeps its answer; on a box it is refined in every step.
enum class Ground { plane, box };

struct Case {
  const char* name;
  std::shared_ptr<const SphereTree> tree;
  double lift;  // of the centre when it lies
};

class AtRest {
 public:
  AtRest(const Case& body, Ground ground) {
    w_.dispatcher.setFinest(
        bullet::Finest::leaves);  // exact contacts would be carried over: the budget would be no limit
    if (ground == Ground::plane)
      w_.addGround();
    else
      w_.add(std::make_shared<btBoxShape>(btVector3(1, 1, btScalar(0.2))), 0, btVector3(0, 0, btScalar(-0.2)));
    body_ = &w_.add(treeShape(body.tree), 1, btVector3(0, 0, btScalar(body.lift + 0.002)));
    body_->setActivationState(DISABLE_DEACTIVATION);
    w_.step(kSettling);
  }

  Unrest watch(Unresolved policy, std::uint64_t mostOperations) {
    w_.dispatcher.setUnresolved(policy);
    std::mt19937_64 engine(kSeed);
    btVector3 sum(0, 0, 0);
    double squares = 0, speedSquares = 0;
    const btVector3 begin = body_->getWorldTransform().getOrigin();
    for (int i = 0; i < kWatched; ++i) {
      const auto operations = static_cast<std::int64_t>(engine() % (mostOperations + 1));
      EXPECT_TRUE(w_.dispatcher.setBudget({operations, {}}).ok());
      w_.step();
      unresolved_ += w_.dispatcher.lastStep().unresolvedPairs;
      const btVector3 moved = body_->getWorldTransform().getOrigin() - begin;
      sum += moved;
      squares += double(moved.length2());
      speedSquares += double(body_->getLinearVelocity().length2());
    }
    const double mean = double((sum / kWatched).length2());
    const double size = double(static_cast<const bullet::SphereTreeShape*>(body_->getCollisionShape())->size());
    return {std::sqrt(speedSquares / kWatched), std::sqrt(std::max(squares / kWatched - mean, 0.0)) / size};
  }

  std::uint64_t unresolved() const { return unresolved_; }

 private:
  BulletWorld<> w_;
  btRigidBody* body_ = nullptr;
  std::uint64_t unresolved_ = 0;
};

std::vector<Case> cases() {
  return {{"cuboid", plainTree(cuboid({0.5, 0.4, 0.3}, 6)), 0.15},
          {"dumbbell", plainTree(twoCuboids({0.2, 0.3, 0.3}, {0.5, 0, 0}, 4)), 0.15},
          {"torus", plainTree(torus(0.3, 0.1, 20)), 0.1}};
}

// Lowest to highest operations a step may have: less than any of the scenes needs, on average.
constexpr std::uint64_t kMaxOperations = 600;

class CutBudget : public testing::TestWithParam<Ground> {};

TEST_P(CutBudget, LeavesABodyAtRest) {
  for (const Case& body : cases()) {
    AtRest scene(body, GetParam());
    const Unrest unrest = scene.watch(Unresolved::guard, kMaxOperations);
    if (GetParam() == Ground::box)
      EXPECT_GT(scene.unresolved(), static_cast<unsigned>(kWatched / 3)) << body.name << ": the budget was no limit";
    EXPECT_LT(unrest.rmsSpeed, 0.5e-3) << body.name;
    EXPECT_LT(unrest.rmsPosition, 1e-4) << body.name;
  }
}

// Unrefined spheres throw bodies about that contacts tested again keep at rest: by a thousand times the speed and more.
TEST(CutBudget_Repel, ThrowsABodyAbout) {
  for (const Case& body : cases()) {
    AtRest scene(body, Ground::box);
    EXPECT_GT(scene.watch(Unresolved::repel, kMaxOperations).rmsSpeed, 0.1) << body.name;
  }
}

INSTANTIATE_TEST_SUITE_P(On, CutBudget, testing::Values(Ground::plane, Ground::box));

}  // namespace
}  // namespace cairn::test::cut_budget_test
