// SPDX-License-Identifier: Zlib
// Three ways in, one narrow phase: what holds behind each of them.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include "cairn/core/round_robin.h"
#include "front_ends.h"
#include "pile.h"

namespace cairn::test::front_end_test {
namespace {

CAIRN_FRONT_END_SUITE(FrontEnd_Budget, EveryFrontEnd);

// On top of refinement come re-tests, at most 32 for each unfinished pair, the head of its front and the spheres of the
// whole bodies, and every leaf pair measured; a leaf pair costs an operation at least to find and five to measure.
TYPED_TEST(FrontEnd_Budget, OfOperationsIsKeptWhileBodiesAndPairsComeAndGo) {
  constexpr std::int64_t kOperations = 3000;
  Pile<TypeParam> limited(kOperations), unlimited({});
  std::uint64_t peak = 0;
  for (int i = 0; i < 240; ++i) {
    if (i % 20 == 19) {
      limited.w.remove(*limited.bodies.front());
      limited.bodies.erase(limited.bodies.begin());
      limited.add(plainTree(ball(0.3, 6)), 20 + i % 3);
    }
    limited.w.step();
    unlimited.w.step();
    const auto& s = limited.w.dispatcher.lastStep();
    EXPECT_LE(s.operations, static_cast<std::uint64_t>(kOperations) * 6 + s.unresolvedPairs * (32U * 5U + 193U * 3U))
        << "step " << i;
    peak = std::max(peak, unlimited.w.dispatcher.lastStep().operations);
  }
  EXPECT_GT(peak, 2U * kOperations * 6) << "the limit never bit: the test shows nothing";
  limited.expectNobodyLost();
}

// Pairs that nobody expected measure what an eighth of the budget each found on top of it: five operations for one.
TYPED_TEST(FrontEnd_Budget, OfOperationsIsKeptByTriangles) {
  constexpr std::int64_t kOperations = 10000;
  Pile<TypeParam> pile(kOperations, 16, 8);
  pile.w.dispatcher.setFinest(bullet::Finest::triangles);
  std::uint32_t exact = 0, rough = 0;
  for (int i = 0; i < 240; ++i) {
    pile.w.step();
    const auto& s = pile.w.dispatcher.lastStep();
    EXPECT_LE(s.operations,
              static_cast<std::uint64_t>(kOperations) * 13 / 8 + s.unresolvedPairs * (32U * 5U + 193U * 3U))
        << "step " << i;
    exact += s.exactContacts;
    rough += s.contacts - s.exactContacts;
  }
  EXPECT_GT(exact, 0U) << "nothing went on to triangles: the test shows nothing";
  EXPECT_GT(rough, 0U) << "the limit never bit: the test shows nothing";
  pile.expectNobodyLost();
}

TYPED_TEST(FrontEnd_Budget, OfNothingOrLittleLosesNobody) {
  for (const std::int64_t operations : {0, 1, 100, 2000}) {
    SCOPED_TRACE(operations);
    Pile<TypeParam> pile(operations);
    pile.w.step(300);
    pile.expectNobodyLost();
    EXPECT_GT(pile.w.dispatcher.lastStep().unresolvedPairs, 0U) << "the budget was no limit: the test shows nothing";
  }
}

TYPED_TEST(FrontEnd_Budget, OfMicrosecondsHoldsThePile) {
  Pile<TypeParam> pile({});
  ASSERT_TRUE(pile.w.dispatcher.setBudget({{}, 0.0}).ok());
  pile.w.step(120);
  EXPECT_GT(pile.w.dispatcher.lastStep().unresolvedPairs, 0U);
  pile.expectNobodyLost();
}

// Where nothing moves and nobody tells when a step ends, a pair that was made anew and comes first looks like the last
// of the step before.
TYPED_TEST(FrontEnd_Budget, IsToldOfAPairMadeAnewThatComesFirst) {
  BulletWorld<TypeParam> w;
  w.addGround();
  w.dispatcher.setFinest(bullet::Finest::leaves);  // which have an error that says who was counted
  const auto tree = plainTree(ball(0.5, 6));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 3; ++i) {
    const auto shape = treeShape(tree);
    const auto scale = btScalar(i == 0 ? 10 : 1);
    shape->setLocalScaling(btVector3(scale, scale, scale));
    bodies.push_back(&w.add(shape, 1, btVector3(btScalar(20 * i), 0, btScalar(0.49) * scale)));
  }
  btOverlappingPairCache& pairs = *w.world.getPairCache();
  const auto* const first = static_cast<btCollisionObject*>(
      (w.world.performDiscreteCollisionDetection(), pairs.getOverlappingPairArray()[0].m_pProxy1->m_clientObject));
  ASSERT_EQ(first, bodies[0]) << "the pair to be made anew is not the first: the test shows nothing";
  const auto looked = [&] {
    w.world.performDiscreteCollisionDetection();
    int contacts = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i)
      contacts += w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
    EXPECT_EQ(w.dispatcher.lastStep().pairs, 3U);
    EXPECT_EQ(w.dispatcher.lastStep().contacts, static_cast<std::uint32_t>(contacts));
    return w.dispatcher.lastStep().worstErrorFraction;
  };
  const double worst = looked();
  EXPECT_GT(worst, 0);
  for (int i = 0; i < 3; ++i) {
    if (i == 0) pairs.cleanProxyFromPairs(bodies[0]->getBroadphaseHandle(), &w.dispatcher);
    EXPECT_EQ(looked(), worst) << "pass " << i;
  }
}

TYPED_TEST(FrontEnd_Budget, ReachesEveryPair) {
  Pile<TypeParam> pile({});
  pile.w.step(120);
  const std::uint64_t usual = pile.mostOperations(30);
  const auto full = pile.w.dispatcher.lastStep();
  EXPECT_EQ(full.unresolvedPairs, 0U);
  EXPECT_GT(full.contacts, 16U);
  int contacts = 0;
  for (int i = 0; i < pile.w.dispatcher.getNumManifolds(); ++i)
    contacts += pile.w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  EXPECT_EQ(full.contacts, static_cast<std::uint32_t>(contacts)) << "all of them pairs with a tree";
  // Half as much again as steps take now: nobody's share may go to others while it is needed.
  ASSERT_TRUE(pile.w.dispatcher.setBudget({static_cast<std::int64_t>(usual) * 3 / 2, {}}).ok());
  pile.w.step(2);
  EXPECT_EQ(pile.w.dispatcher.lastStep().unresolvedPairs, 0U);
}

TYPED_TEST(FrontEnd_Budget, ServesANewPairInItsFirstStep) {
  Pile<TypeParam> pile({}, 4);
  const std::uint64_t most = pile.mostOperations(120);
  const auto full = pile.w.dispatcher.lastStep();
  ASSERT_TRUE(pile.w.dispatcher.setBudget({static_cast<std::int64_t>(most) * 100, {}}).ok());
  for (int i = 0; i < 3; ++i) {
    pile.w.add(treeShape(plainTree(ball(0.3, 6))), 1, btVector3(5 + btScalar(i), 0, btScalar(0.29)));
    pile.w.step();
    EXPECT_GT(pile.w.dispatcher.lastStep().pairs, full.pairs);
    EXPECT_EQ(pile.w.dispatcher.lastStep().unresolvedPairs, 0U);
  }
}

// An unfinished pair says nothing under this policy: the new one must have been finished, though nobody else is.
TYPED_TEST(FrontEnd_Budget, KeepsSomethingForANewPair) {
  Pile<TypeParam> pile(5000);
  pile.w.dispatcher.setUnresolved(bullet::Unresolved::ignore);
  pile.w.dispatcher.setFinest(bullet::Finest::leaves);  // triangles take what is left
  pile.w.step(60);
  ASSERT_GT(pile.w.dispatcher.lastStep().unresolvedPairs, 10U);
  const btRigidBody& small =
      pile.w.add(treeShape(plainTree(cuboid({0.2, 0.2, 0.2}, 1))), 1, btVector3(9, 0, btScalar(0.099)));
  int contacts = 0;
  pile.w.world.performDiscreteCollisionDetection();
  for (int i = 0; i < pile.w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *pile.w.dispatcher.getManifoldByIndexInternal(i);
    if (m.getBody1() == &small || m.getBody0() == &small) contacts += m.getNumContacts();
  }
  EXPECT_GE(contacts, 3);
}

TYPED_TEST(FrontEnd_Budget, GivesTheSameBitsTwice) {
  Pile<TypeParam> first(3000), second(3000);
  first.w.step(150);
  second.w.step(150);
  EXPECT_EQ(first.w.stateHash(), second.w.stateHash());
}

// The same pass, collected and answered at the same place.
TEST(FrontEnd_SameBits, DispatcherAndInstalledOnWorldUnderABudget) {
  for (const std::optional<std::int64_t> operations : {std::optional<std::int64_t>(1000), {5000}, {}}) {
    Pile<bullet::Dispatcher<>> own(operations);
    Pile<InstalledOnWorld> installed(operations);
    for (int i = 0; i < 200; ++i) {
      own.w.step();
      installed.w.step();
      ASSERT_EQ(own.w.stateHash(), installed.w.stateHash()) << "step " << i;
    }
    EXPECT_EQ(own.w.dispatcher.lastStep().operations, installed.w.dispatcher.lastStep().operations);
  }
}

struct CountingPriority final : Priority {
  int* begins;
  RoundRobin roundRobin;
  explicit CountingPriority(int& count) : begins(&count) {}
  void begin(std::span<const ScheduledPair> pairs) override {
    ++*begins;
    roundRobin.begin(pairs);
  }
  std::optional<std::size_t> next() override { return roundRobin.next(); }
  void turnEnded(std::size_t pair, Progress progress) override { roundRobin.turnEnded(pair, progress); }
};

CAIRN_FRONT_END_SUITE(FrontEnd_Steps, EveryFrontEnd);

TYPED_TEST(FrontEnd_Steps, AreOneForEachSubstep) {
  int begins = 0;
  Pile<TypeParam> pile(20000);
  pile.w.dispatcher.setPriority(std::make_unique<CountingPriority>(begins));
  pile.w.step(30);
  EXPECT_EQ(begins, 30);
  pile.w.world.stepSimulation(btScalar(1) / 60, 8, btScalar(1) / 240 * btScalar(0.9999));
  EXPECT_EQ(begins, 34);
}

// A stranger to the step that comes first must not be taken for the last one's.
// Also those for which there is room only after others took less than expected.
TYPED_TEST(FrontEnd_Steps, CountEachPairOnce) {
  for (const std::int64_t operations : {200, 2000, 10000}) {
    Pile<TypeParam> pile(operations, 20);
    std::uint64_t held = 0;
    for (btRigidBody* body : pile.bodies) body->setActivationState(DISABLE_DEACTIVATION);
    for (int i = 0; i < 120; ++i) {
      pile.w.step();
      const bullet::StepStatistics& step = pile.w.dispatcher.lastStep();
      ASSERT_EQ(step.pairs, static_cast<unsigned>(pile.w.world.getPairCache()->getNumOverlappingPairs()))
          << operations << " operations, step " << i;
      held += step.unresolvedPairs;
    }
    EXPECT_GT(held, 0U) << "enough for all: the test shows nothing";
  }
}

TYPED_TEST(FrontEnd_Steps, BeginWithANewPairToo) {
  int begins = 0;
  BulletWorld<TypeParam> w;
  w.dispatcher.setPriority(std::make_unique<CountingPriority>(begins));
  ASSERT_TRUE(w.dispatcher.setBudget({1000000, {}})) << "without one nobody is asked";
  w.world.getDispatchInfo().m_deterministicOverlappingPairs = true;  // the last added come first
  w.add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, -1));
  const auto tree = plainTree(ball(0.3, 4));
  btRigidBody& early = w.add(treeShape(tree), 1, btVector3(2, 0, btScalar(0.31)));
  btRigidBody& late = w.add(treeShape(tree), 1, btVector3(0, 0, 3));
  early.setActivationState(DISABLE_DEACTIVATION);
  late.setActivationState(DISABLE_DEACTIVATION);
  early.setFriction(0);
  early.setLinearVelocity(btVector3(btScalar(0.1), 0, 0));
  for (int i = 0; i < 90; ++i) {
    const int before = begins;
    w.step();
    EXPECT_EQ(begins, before + 1) << "step " << i;
    EXPECT_EQ(w.dispatcher.lastStep().pairs, static_cast<unsigned>(w.world.getPairCache()->getNumOverlappingPairs()))
        << "step " << i;
    if (i == 0) EXPECT_EQ(w.dispatcher.lastStep().pairs, 1U);
  }
  EXPECT_EQ(w.dispatcher.lastStep().pairs, 2U) << "the late one never came down: the test shows nothing";
}

std::vector<btRigidBody*> gMoving;

bool moveAllButTheseTwo(btManifoldPoint&, const btCollisionObjectWrapper* a, int, int,
                        const btCollisionObjectWrapper* b, int, int) {
  for (btRigidBody* body : std::exchange(gMoving, {}))
    if (body != a->getCollisionObject() && body != b->getCollisionObject()) body->translate(btVector3(0, 0, 5));
  return false;
}

// An answer prepared at the start of the step is not used for bodies that have moved since.
TEST(FrontEnd_OpenStep, SeesBodiesMovedByACallback) {
  BulletWorld<InstalledOnDispatcher> w;
  w.addGround();
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 4; ++i) {
    bodies.push_back(&w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(2 * btScalar(i), 0, 0.5)));
    bodies.back()->setCollisionFlags(btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  }
  w.world.performDiscreteCollisionDetection();
  EXPECT_EQ(w.dispatcher.lastStep().contacts, 16U);
  gMoving = bodies;
  gContactAddedCallback = moveAllButTheseTwo;
  w.world.performDiscreteCollisionDetection();
  gContactAddedCallback = nullptr;
  ASSERT_TRUE(gMoving.empty());
  int contacts = 0;
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i)
    contacts += w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  EXPECT_EQ(contacts, 4) << "of the one body that stayed";
}

BulletWorld<InstalledOnDispatcher>* gWorld;
btRigidBody* gRemoved;

// Two balls of a metre whose boxes overlap though they do not touch.
const btVector3 kTouching(btScalar(0.95), 0, 0), kBeside(btScalar(0.9), btScalar(0.9), 0);

// Contacts end while a step begins: who is told of it may remove what the same step expects.
TEST(FrontEnd_OpenStep, SkipsABodyThatIsRemovedWhenAContactEnds) {
  const auto round = treeShape(plainTree(ball(0.5, 5)));
  BulletWorld<InstalledOnDispatcher> w;
  gWorld = &w;
  const btVector3 far(10, 0, 0);
  w.add(round, 1, btVector3(0, 0, 0));
  btRigidBody& moved = w.add(round, 1, kTouching);
  w.add(round, 1, far);
  gRemoved = &w.add(round, 1, far + kTouching);
  for (int i = 0; i < 2; ++i) w.world.performDiscreteCollisionDetection();
  ASSERT_EQ(w.dispatcher.lastStep().pairs, 2U);
  ASSERT_GE(w.dispatcher.lastStep().contacts, 2U);
  gContactEndedCallback = [](btPersistentManifold* const&) {
    if (btRigidBody* const body = std::exchange(gRemoved, nullptr)) gWorld->remove(*body);
  };
  moved.translate(kBeside - kTouching);
  w.world.performDiscreteCollisionDetection();
  gContactEndedCallback = nullptr;
  EXPECT_FALSE(gRemoved) << "no contact ended: the test shows nothing";
  EXPECT_EQ(w.dispatcher.lastStep().contacts, 0U);
  w.world.performDiscreteCollisionDetection();
  EXPECT_EQ(w.dispatcher.lastStep().pairs, 1U);
}

CAIRN_FRONT_END_SUITE(FrontEnd_Queries, EveryFrontEnd);

struct Count final : btCollisionWorld::ContactResultCallback {
  int points = 0;
  btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*,
                           int, int) override {
    ++points;
    return 0;
  }
};

// Queries of a contact callback to the world while a step is being answered.
struct Asker {
  btCollisionWorld* world = nullptr;
  btCollisionObject *a = nullptr, *b = nullptr;
  int asked = 0, found = 0;
};
Asker gAsker;

bool askInCallback(btManifoldPoint&, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*, int,
                   int) {
  if (gAsker.asked > 0) return false;
  ++gAsker.asked;
  Count pairTest, test;
  gAsker.world->contactPairTest(gAsker.a, gAsker.b, pairTest);
  gAsker.world->contactTest(gAsker.a, test);
  gAsker.found = std::min(pairTest.points, test.points);
  return false;
}

TYPED_TEST(FrontEnd_Queries, AreAnsweredInFullInsideAStepWithoutBudget) {
  Pile<TypeParam> pile(0, 6);
  btRigidBody& ground = *btRigidBody::upcast(pile.w.world.getCollisionObjectArray()[0]);
  btRigidBody& body = pile.w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(5, 0, btScalar(0.45)));
  for (btRigidBody* b : pile.bodies)
    b->setCollisionFlags(b->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  gAsker = {&pile.w.world, &body, &ground, 0, 0};
  gContactAddedCallback = askInCallback;
  for (int i = 0; i < 60 && gAsker.asked == 0; ++i) {
    body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(5, 0, btScalar(0.45))));
    pile.w.step();
  }
  gContactAddedCallback = nullptr;
  ASSERT_EQ(gAsker.asked, 1) << "no contact in a step: the test shows nothing";
  EXPECT_GE(gAsker.found, 3);
  pile.w.step(10);
  for (const btRigidBody* b : pile.bodies) EXPECT_TRUE(isSane(*b));
}

CAIRN_FRONT_END_SUITE(FrontEnd_Character, EveryFrontEnd);

// It asks for contacts several times a step, with the pairs of its own ghost.
TYPED_TEST(FrontEnd_Character, WalksUpToATreeAndStopsThoughThereIsNoBudget) {
  btGhostPairCallback pairs;
  int begins = 0;
  BulletWorld<TypeParam> w;
  w.world.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
  w.add(treeShape(plainTree(cuboid({8, 8, 1}, 8))), 0, btVector3(0, 0, btScalar(-0.5)));
  w.add(treeShape(plainTree(cuboid({1, 6, 2}, 6))), 0, btVector3(2, 0, 1));
  btRigidBody& loose = w.add(treeShape(plainTree(ball(0.3, 4))), 1, btVector3(-2, 0, btScalar(0.4)));
  loose.setActivationState(DISABLE_DEACTIVATION);
  btPairCachingGhostObject ghost;
  btCapsuleShapeZ capsule(btScalar(0.3), btScalar(0.8));
  ghost.setCollisionShape(&capsule);
  ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.75))));
  w.world.addCollisionObject(&ghost, btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::AllFilter);
  btKinematicCharacterController character(&ghost, &capsule, btScalar(0.2), btVector3(0, 0, 1));
  character.setGravity(btVector3(0, 0, btScalar(-9.81)));
  w.world.addAction(&character);
  ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  w.dispatcher.setPriority(std::make_unique<CountingPriority>(begins));
  character.setWalkDirection(btVector3(btScalar(0.03), 0, 0));
  w.step(200);
  EXPECT_EQ(begins, 200) << "looking around is no step";
  const btVector3 p = ghost.getWorldTransform().getOrigin();
  EXPECT_NEAR(p.x(), 1.2, 0.1) << "the wall begins at 1.5, the capsule's radius is 0.3";
  EXPECT_NEAR(p.z(), 0.7, 0.1);
  w.world.removeAction(&character);
  w.world.removeCollisionObject(&ghost);
}

}  // namespace
}  // namespace cairn::test::front_end_test
