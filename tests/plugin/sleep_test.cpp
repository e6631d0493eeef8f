// SPDX-License-Identifier: Zlib
// A body on guards may be in mid-air, or tilted: Bullet must not put it to sleep there, only where there is an
// answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::sleep_test {
namespace {

constexpr int kFourSeconds = 240;  // twice as long as Bullet waits
// A body at rest is nearer to what holds it.
constexpr btScalar kMidAir = btScalar(0.01);

// Cubes that cannot turn are pressed with a side against the edge of other cubes, along the diagonal: the spheres
// around the whole cubes meet before they do.
struct Cubes {
  BulletWorld<> w;
  std::vector<btRigidBody*> bodies;

  explicit Cubes(int count, const bullet::StepBudget& budget) {
    constexpr btScalar kApart = 5;
    w.world.setGravity(btVector3(-7, -7, 0));
    EXPECT_TRUE(w.dispatcher.setBudget(budget).ok());
    const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
    for (int i = 0; i < count; ++i) {
      w.add(cube, 0, btVector3(0, 0, kApart * btScalar(i)));
      bodies.push_back(&w.add(cube, 1, btVector3(btScalar(0.95), btScalar(0.95), kApart * btScalar(i)),
                              btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI / 2)));
      bodies.back()->setAngularFactor(0);
    }
  }
  // From the edge to the side.
  static btScalar gapOf(const btRigidBody& body) {
    const btVector3& p = body.getWorldTransform().getOrigin();
    return (p.x() + p.y()) / btSqrt(btScalar(2)) - btSqrt(btScalar(0.5)) - btScalar(0.5);
  }
  int asleepInMidAir() const {
    return static_cast<int>(std::ranges::count_if(
        bodies, [](const btRigidBody* body) { return !body->isActive() && gapOf(*body) > kMidAir; }));
  }
};

TEST(Sleep, IsNotOnSpheresOfWholeBodies) {
  Cubes cubes(1, {0, {}});
  const btRigidBody& body = *cubes.bodies[0];
  cubes.w.step(kFourSeconds);
  ASSERT_EQ(cubes.w.dispatcher.lastStep().contacts, 1U) << "no sphere stands in";
  EXPECT_GT(Cubes::gapOf(body), 10 * kMidAir);
  EXPECT_TRUE(body.isActive());
  ASSERT_TRUE(cubes.w.dispatcher.setBudget({}).ok());
  cubes.w.step(kFourSeconds);
  EXPECT_FALSE(body.isActive());
  EXPECT_LT(Cubes::gapOf(body), kMidAir);
}

// In steps that are late for most pairs, what was said stays as it was.
TEST(Sleep, IsNotOnSpheresInLateSteps) {
  Cubes cubes(300, {std::nullopt, 20.0});
  cubes.w.step(kFourSeconds);
  EXPECT_EQ(cubes.asleepInMidAir(), 0);
}

// A body that Bullet wants to sleep may creep on for as long as something keeps its island awake. What the user sends
// to sleep goes.
TEST(Sleep, IsPutOffWhereBulletWantsItOnly) {
  for (const bool isUsers : {false, true}) {
    Cubes cubes(1, {0, {}});
    btRigidBody& body = *cubes.bodies[0];
    cubes.w.step(kFourSeconds);
    body.setActivationState(WANTS_DEACTIVATION);
    body.setDeactivationTime(isUsers ? 0 : btScalar(2.1));
    cubes.w.step();
    EXPECT_EQ(body.isActive(), !isUsers);
  }
}

// Twenty towers of six slabs, for twenty seconds; then without a budget for half a second. Returns how many were asleep
// and fall by more than two centimetres.
int asleepThatFall(std::uint64_t seed, std::int64_t operations, int& asleep) {
  constexpr int kTowers = 20, kSlabs = 6;
  constexpr btScalar kFall = btScalar(0.02);
  std::mt19937_64 engine(seed);
  const auto any = [&](double most) { return btScalar(uniform(engine, -most, most)); };
  BulletWorld<> w;
  w.addGround();
  EXPECT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
  const auto slab = treeShape(plainTree(cuboid({0.8, 0.8, 0.4}, 4)));
  std::vector<btRigidBody*> bodies;
  for (int t = 0; t < kTowers; ++t)
    for (int i = 0; i < kSlabs; ++i) {
      const btVector3 at(btScalar(3 * (t % 5)) + any(0.1), btScalar(3 * (t / 5)) + any(0.1),
                         btScalar(0.25) + btScalar(0.45) * btScalar(i));
      bodies.push_back(&w.add(slab, 1, at, btQuaternion(btVector3(0, 0, 1), any(0.5))));
    }
  w.step(1200);
  std::vector<std::pair<btRigidBody*, btScalar>> sleepers;
  for (btRigidBody* body : bodies)
    if (!body->isActive()) sleepers.emplace_back(body, body->getWorldTransform().getOrigin().z());
  EXPECT_TRUE(w.dispatcher.setBudget({}).ok());
  for (btRigidBody* body : bodies) body->activate(true);
  w.step(30);
  asleep += static_cast<int>(sleepers.size());
  return static_cast<int>(std::ranges::count_if(sleepers, [](const auto& sleeper) {
    return sleeper.second - sleeper.first->getWorldTransform().getOrigin().z() > kFall;
  }));
}

// Guards beside points that carry nothing hold a tilted slab as well as guards alone do: 32 of 360 slabs fell. A slab
// that leans may slip by itself once woken: of thirty seeds 0 of 3519 in single precision and 1 of 3436 in double.
TEST(Sleep, IsNotOnGuardsThatCarry) {
  int asleep = 0, fall = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) fall += asleepThatFall(seed, 3000, asleep);
  EXPECT_LE(fall, asleep / 100);
  EXPECT_GT(asleep, 300) << "of 360";
}

}  // namespace
}  // namespace cairn::test::sleep_test
