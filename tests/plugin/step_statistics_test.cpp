// SPDX-License-Identifier: Zlib
// The statistics of a step.
#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "bullet_world.h"

namespace cairn::test::step_statistics_test {
namespace {

constexpr std::uint32_t kSeed = 5;

bool isTree(const btCollisionObject& object) {
  return bullet::asSphereTree(object.getCollisionShape()) != nullptr;
}

// Of manifolds with a tree.
std::uint32_t pointsHeld(btDispatcher& dispatcher) {
  std::uint32_t points = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *dispatcher.getManifoldByIndexInternal(i);
    if (isTree(*m.getBody0()) || isTree(*m.getBody1())) points += static_cast<std::uint32_t>(m.getNumContacts());
  }
  return points;
}

// Bullet takes two points of different leaves that come to lie in one place for one.
TEST(StepStatistics, CountThePointsThatTheManifoldsHold) {
  std::mt19937 random(kSeed);
  const auto at = [&](double lower, double upper) {
    return btScalar(std::uniform_real_distribution<double>(lower, upper)(random));
  };
  const auto cube = plainTree(cuboid({1, 1, 1}, 3)), round = plainTree(ball(0.5, 5));
  const btScalar half = btScalar(0.5);
  BulletWorld<> w;
  w.addGround();
  for (int step = 0; step < 300; ++step) {
    if (step % 8 == 0 && step < 200) {
      std::shared_ptr<btCollisionShape> shape = std::make_shared<btBoxShape>(btVector3(half, half, half));
      if (step % 24 < 16) shape = treeShape(step % 24 == 0 ? cube : round);
      const btVector3 place(at(-2, 2), at(-2, 2), at(0.5, 4));
      // Bullet does not ask about pairs that sleep.
      w.add(std::move(shape), 1, place).setActivationState(DISABLE_DEACTIVATION);
    }
    w.step();
    ASSERT_EQ(w.dispatcher.lastStep().contacts, pointsHeld(w.dispatcher)) << "seed " << kSeed << ", step " << step;
  }
}

constexpr std::chrono::milliseconds kSlept{20};
constexpr double kSleptUs = std::chrono::duration<double, std::micro>(kSlept).count();

// Bullet's pass over its pairs sleeps so long at each.
void sleepAtPairs(btCollisionDispatcher& dispatcher) {
  dispatcher.setNearCallback([](btBroadphasePair& pair, btCollisionDispatcher& d, const btDispatcherInfo& info) {
    std::this_thread::sleep_for(kSlept);
    btCollisionDispatcher::defaultNearCallback(pair, d, info);
  });
}

template <class World>
void standOnGround(World& w) {
  w.addGround();
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
}

TEST(StepStatistics, TellByHowMuchADeadlineWasMissed) {
  BulletWorld<> w;
  standOnGround(w);
  constexpr double kDeadlineUs = 1000;
  ASSERT_TRUE(w.dispatcher.setBudget({.operations = {}, .microseconds = kDeadlineUs}));
  sleepAtPairs(w.dispatcher);
  w.step();
  const bullet::StepStatistics& step = w.dispatcher.lastStep();
  ASSERT_EQ(step.pairs, 1U);
  EXPECT_EQ(step.deadlineMicroseconds, kDeadlineUs);
  EXPECT_GE(step.elapsedMicroseconds, kSleptUs);
  EXPECT_EQ(step.missedByMicroseconds, step.elapsedMicroseconds - kDeadlineUs);
#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)  // a thread's own time is not known there
  EXPECT_LT(step.microseconds, step.elapsedMicroseconds - kSleptUs / 2) << "asleep it takes no processor time";
#endif
}

TEST(StepStatistics, KnowNoDeadlineWithoutABudgetInTime) {
  BulletWorld<> w;
  standOnGround(w);
  ASSERT_TRUE(w.dispatcher.setBudget({.operations = 100, .microseconds = {}}));
  sleepAtPairs(w.dispatcher);
  w.step();
  const bullet::StepStatistics& step = w.dispatcher.lastStep();
  EXPECT_GE(step.elapsedMicroseconds, kSleptUs);
  EXPECT_FALSE(step.deadlineMicroseconds);
  EXPECT_EQ(step.missedByMicroseconds, 0);
}

// A minute is never missed by what takes a few microseconds.
TEST(StepStatistics, MissNoDeadlineThatIsFarOff) {
  BulletWorld<> w;
  standOnGround(w);
  ASSERT_TRUE(w.dispatcher.setBudget({.operations = {}, .microseconds = 6e7}));
  w.step();
  EXPECT_EQ(w.dispatcher.lastStep().deadlineMicroseconds, 6e7);
  EXPECT_EQ(w.dispatcher.lastStep().missedByMicroseconds, 0);
}

}  // namespace
}  // namespace cairn::test::step_statistics_test
