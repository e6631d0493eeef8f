// SPDX-License-Identifier: Zlib
//
// The last answers of single pairs are those that the step's statistics sum up.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "cairn/bullet/contact_points.h"
#include "cairn/bullet/install.h"
#include "walled_heap.h"

namespace cairn::test {
namespace {

using bullet::PairAnswered;
using bullet::StepStatistics;
using Objects = std::pair<const btCollisionObject*, const btCollisionObject*>;

// Points that the solver got, pair by pair.
std::map<Objects, std::uint32_t> pointsOf(const btDispatcher& dispatcher) {
  auto& manifolds = const_cast<btDispatcher&>(dispatcher);  // Bullet's reader is not const
  std::map<Objects, std::uint32_t> points;
  for (int i = 0; i < manifolds.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds.getManifoldByIndexInternal(i);
    const Objects objects = std::minmax<const btCollisionObject*>(manifold.getBody0(), manifold.getBody1());
    if (manifold.getNumContacts() > 0) points[objects] += static_cast<std::uint32_t>(manifold.getNumContacts());
  }
  return points;
}

int countGuards(const btDispatcher& dispatcher) {
  auto& manifolds = const_cast<btDispatcher&>(dispatcher);
  int count = 0;
  for (int i = 0; i < manifolds.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) count += bullet::isGuard(manifold.getContactPoint(k));
  }
  return count;
}

void expectSums(const std::vector<PairAnswered>& answers, const StepStatistics& step) {
  std::uint32_t contacts = 0, unresolved = 0;
  double worst = 0;
  for (const PairAnswered& answer : answers) {
    contacts += answer.contacts;
    unresolved += answer.isUnresolved ? 1 : 0;
    worst = std::max(worst, answer.errorFraction);
  }
  EXPECT_EQ(contacts, step.contacts);
  EXPECT_EQ(unresolved, step.unresolvedPairs);
  EXPECT_EQ(worst, step.worstErrorFraction);
}

void keepAwake(const WalledHeap& heap) {
  for (btRigidBody* body : heap.bodies) body->setActivationState(DISABLE_DEACTIVATION);
}

class PairAnswers : public testing::TestWithParam<std::optional<std::int64_t>> {};

TEST_P(PairAnswers, AreThoseThatTheStepSumsUp) {
  WalledHeap heap(GetParam());
  keepAwake(heap);
  std::uint32_t unresolved = 0, contacts = 0;
  for (int step = 0; step < 150; ++step) {
    heap.run(1);
    expectSums(heap.w.dispatcher.lastAnswers(), heap.w.dispatcher.lastStep());
    unresolved += heap.w.dispatcher.lastStep().unresolvedPairs;
    contacts += heap.w.dispatcher.lastStep().contacts;
  }
  EXPECT_GT(contacts, 0U);
  EXPECT_EQ(unresolved > 0, GetParam().has_value());
}

// A pair that is finished over several steps keeps guards as well, for surfaces that it ruled out long ago.
TEST_P(PairAnswers, AreGuardsOnABudgetAlone) {
  WalledHeap heap(GetParam());
  keepAwake(heap);
  int guards = 0;
  for (int step = 0; step < 150; ++step) {
    heap.run(1);
    const int now = countGuards(heap.w.dispatcher);
    ASSERT_LE(now, static_cast<int>(heap.w.dispatcher.lastStep().contacts));
    guards += now;
  }
  EXPECT_EQ(guards > 0, GetParam().has_value());
}

TEST_P(PairAnswers, NameTheBodiesThatTouch) {
  WalledHeap heap(GetParam());
  keepAwake(heap);
  for (int step = 0; step < 150; ++step) {
    heap.run(1);
    std::map<Objects, std::uint32_t> told;
    for (const PairAnswered& answer : heap.w.dispatcher.lastAnswers())
      if (answer.contacts > 0) told[std::minmax(answer.first, answer.second)] += answer.contacts;
    ASSERT_EQ(told, pointsOf(heap.w.dispatcher)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Budgets, PairAnswers, testing::Values(std::nullopt, 1000, 0));

TEST(PairAnswersAtRest, StayWhileBodiesSleep) {
  WalledHeap heap(std::nullopt);
  heap.run(1500);
  ASSERT_TRUE(std::ranges::none_of(heap.bodies, &btRigidBody::isActive));
  EXPECT_EQ(heap.w.dispatcher.lastStep().pairs, 0U);
  EXPECT_GT(heap.w.dispatcher.lastAnswers().size(), heap.bodies.size());
}

TEST(PairAnswersAtRest, EndWithTheirBodies) {
  WalledHeap heap(std::nullopt);
  heap.run(100);
  const btRigidBody* const gone = heap.bodies.back();
  heap.w.remove(*heap.bodies.back());
  for (const PairAnswered& answer : heap.w.dispatcher.lastAnswers())
    EXPECT_TRUE(answer.first != gone && answer.second != gone);
}

TEST(PairAnswersInstalled, AreThoseThatTheStepSumsUp) {
  BulletWorld<btCollisionDispatcher> w;
  auto narrowPhase = bullet::install(w.world);
  ASSERT_TRUE(narrowPhase.ok());
  ASSERT_TRUE(narrowPhase.value().setBudget({.operations = 300, .microseconds = {}}).ok());
  w.addGround();
  for (int i = 0; i < 6; ++i)
    w.add(treeShape(WalledHeap::round()), 1, {0, 0, btScalar(0.4 + 0.7 * i)}).setActivationState(DISABLE_DEACTIVATION);
  for (int step = 0; step < 100; ++step) {
    w.step();
    expectSums(narrowPhase.value().lastAnswers(), narrowPhase.value().lastStep());
  }
}

}  // namespace
}  // namespace cairn::test
