// SPDX-License-Identifier: Zlib
// A narrow phase that comes to a dispatcher or world of somebody else's, and goes again: nothing of theirs is harmed,
// nothing of ours is left behind.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btCollisionDispatcherMt.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <LinearMath/btThreads.h>

#include "counting_create.h"
#include "front_ends.h"
#include "triangle_grounds.h"

namespace cairn::test::install_test {
namespace {

using bullet::install;
using bullet::NarrowPhase;
using StockWorld = BulletWorld<btCollisionDispatcher>;

// On the stock dispatcher or world, by a parameter.
class Installed : public testing::TestWithParam<bool> {
 protected:
  static Result<NarrowPhase> installOn(StockWorld& w) {
    return GetParam() ? install(static_cast<btCollisionWorld&>(w.world)) : install(w.dispatcher);
  }
};
INSTANTIATE_TEST_SUITE_P(OnWorld, Installed, testing::Bool());

btRigidBody& addCubeOnBox(StockWorld& w) {
  w.add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, -1));
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
  body.setActivationState(DISABLE_DEACTIVATION);
  return body;
}

TEST_P(Installed, IsRefusedTwice) {
  StockWorld w;
  {
    const auto first = installOn(w);
    ASSERT_TRUE(first.ok());
    const auto second = installOn(w);
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.error().message.find("already"), std::string::npos);
  }
  EXPECT_TRUE(installOn(w).ok()) << "after the first is gone";
  BulletWorld<> own;
  EXPECT_FALSE(install(own.dispatcher).ok());
  EXPECT_FALSE(install(static_cast<btCollisionWorld&>(own.world)).ok());
}

TEST(Install_Errors, NameWhatCannotBeServed) {
  btDefaultCollisionConfiguration configuration;
  btDbvtBroadphase broadphase;
  btCollisionWorld without(nullptr, &broadphase, &configuration);
  const auto nothing = install(without);
  ASSERT_FALSE(nothing.ok());
  EXPECT_NE(nothing.error().message.find("dispatcher"), std::string::npos);

  btSetTaskScheduler(btGetSequentialTaskScheduler());
  btCollisionDispatcherMt threaded(&configuration);
  const auto many = install(static_cast<btCollisionDispatcher&>(threaded));
  ASSERT_FALSE(many.ok());
  EXPECT_NE(many.error().message.find("Dispatcher<btCollisionDispatcherMt>"), std::string::npos);
}

TEST_P(Installed, ServesATreeFromThenOnAndBulletAfterwards) {
  StockWorld w;
  std::optional<NarrowPhase> cairn = installOn(w).value();
  const btRigidBody& body = addCubeOnBox(w);
  w.step(60);
  EXPECT_EQ(cairn->lastStep().pairs, 1U);
  EXPECT_EQ(cairn->lastStep().contacts, 4U);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, bullet::kSpeculativeFraction);
  cairn.reset();
  w.step(120);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, 0.08) << "Bullet's triangles have margins, ours none";
}

// Bullet's algorithms for the pairs it knows hold on to what they need.
TEST_P(Installed, MayGoWhileBulletHoldsItsPairs) {
  StockWorld w;
  btRigidBody& body = addCubeOnBox(w);
  auto compound = std::make_shared<btCompoundShape>();
  const auto child = treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2)));
  compound->addChildShape(btTransform::getIdentity(), child.get());
  btRigidBody& second = w.add(compound, 1, btVector3(2, 0, btScalar(0.25)));
  {
    NarrowPhase cairn = installOn(w).value();
    ASSERT_TRUE(cairn.setBudget({50, {}}).ok());
    w.step(10);
    ASSERT_EQ(cairn.lastStep().pairs, 2U);
  }
  w.step(60);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, 0.08);
  EXPECT_NEAR(second.getWorldTransform().getOrigin().z(), 0.25, 0.08);
  const auto again = installOn(w);
  w.step(10);
  w.remove(body);
  w.step(10);
  w.remove(second);
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0);
}

TEST_P(Installed, MovesToAnotherOwner) {
  StockWorld w, other;
  addCubeOnBox(w);
  auto result = installOn(w);
  NarrowPhase first = std::move(result).value();
  auto second = std::make_unique<NarrowPhase>(std::move(first));
  ASSERT_TRUE(second->setBudget({1000, {}}).ok());
  w.step(5);
  *second = installOn(other).value();
  addCubeOnBox(other);
  other.step(5);
  EXPECT_EQ(second->lastStep().pairs, 1U);
  w.step(5);
  EXPECT_TRUE(installOn(w).ok()) << "given back when another took its place";
}

TEST(InstalledOnAWorld, TakesOverWhatBulletKnowsAndGivesItBack) {
  StockWorld w;
  const btRigidBody& body = addCubeOnBox(w);
  w.step(60);
  const btBroadphaseInterface* const theirs = w.world.getBroadphase();
  {
    const NarrowPhase cairn = install(static_cast<btCollisionWorld&>(w.world)).value();
    w.step(60);
    EXPECT_EQ(cairn.lastStep().pairs, 1U);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, bullet::kSpeculativeFraction);
    // The world's own business goes through as ever.
    btVector3 lower, upper;
    w.world.getBroadphase()->getBroadphaseAabb(lower, upper);
    EXPECT_LT(lower.z(), -1);
    btCollisionWorld::ClosestRayResultCallback ray(btVector3(0, 0, 5), btVector3(0, 0, -5));
    w.world.rayTest(ray.m_rayFromWorld, ray.m_rayToWorld, ray);
    EXPECT_EQ(ray.m_collisionObject, &body);
    w.world.updateSingleAabb(w.world.getCollisionObjectArray()[1]);
    EXPECT_EQ(w.world.getPairCache()->getNumOverlappingPairs(), 1);
  }
  EXPECT_EQ(w.world.getBroadphase(), theirs);
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0) << "Bullet asks for new algorithms";
  w.step(60);
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 1);
}

TEST(InstalledOnAWorld, ServesOneWithoutDynamics) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  const NarrowPhase cairn = install(world).value();
  const auto tree = treeShape(plainTree(cuboid({1, 1, 1}, 3)));
  btCollisionObject a, b;
  a.setCollisionShape(tree.get());
  b.setCollisionShape(tree.get());
  b.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.95), 0, 0)));
  world.addCollisionObject(&a);
  world.addCollisionObject(&b, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(cairn.lastStep().pairs, 1U);
  EXPECT_GE(cairn.lastStep().contacts, 3U);
  EXPECT_GE(dispatcher.getNumManifolds(), 1) << "at once, without a solver";
  world.removeCollisionObject(&a);
  world.removeCollisionObject(&b);
}

// A tree on a plane, stepped for a second, and taken out of the narrow phase and the world again.
void expectToServe(btDiscreteDynamicsWorld& world) {
  std::optional<NarrowPhase> cairn = install(static_cast<btCollisionWorld&>(world)).value();
  ASSERT_TRUE(cairn->setBudget({20000, {}}).ok());
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btRigidBody ground(0, nullptr, &plane);
  const auto tree = treeShape(plainTree(cuboid({1, 1, 1}, 3)));
  btRigidBody body(1, nullptr, tree.get(), btVector3(1, 1, 1) / 6);
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(0.52))));
  world.addRigidBody(&ground);
  world.addRigidBody(&body);
  for (int i = 0; i < 60; ++i) {
    world.stepSimulation(btScalar(1) / 60, 0);
    ASSERT_EQ(cairn->lastStep().pairs, 1U);
  }
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, bullet::kSpeculativeFraction);
  world.removeRigidBody(&ground);
  world.stepSimulation(btScalar(1) / 60, 0);
  EXPECT_EQ(cairn->lastStep().pairs, 0U);
  cairn.reset();
  world.removeRigidBody(&body);
}

TEST(InstalledOnAWorld, ServesEveryKindOfWorldSolverAndBroadPhase) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase tree;
  btSimpleBroadphase list;
  btAxisSweep3 sweep(btVector3(-50, -50, -50), btVector3(50, 50, 50));
  for (btBroadphaseInterface* broadphase : std::initializer_list<btBroadphaseInterface*>{&tree, &list, &sweep}) {
    btDiscreteDynamicsWorld ownsItsSolver(&dispatcher, broadphase, nullptr, &configuration);
    expectToServe(ownsItsSolver);
    btMultiBodyConstraintSolver solver;
    btMultiBodyDynamicsWorld multiBody(&dispatcher, broadphase, &solver, &configuration);
    expectToServe(multiBody);
  }
}

TEST(Install_Threads, AreServedByADispatcherOfTheirOwn) {
  btSetTaskScheduler(btGetSequentialTaskScheduler());
  BulletWorld<bullet::Dispatcher<btCollisionDispatcherMt>> w;
  w.addGround();
  const btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.52)));
  w.step(60);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, bullet::kSpeculativeFraction);
}

TEST_P(Installed, GivesTheTablesBackWhatTheyHad) {
  CountingCreate before, after;
  StockWorld w;
  w.dispatcher.registerCollisionCreateFunc(FAST_CONCAVE_MESH_PROXYTYPE, BOX_SHAPE_PROXYTYPE, &before);
  w.dispatcher.registerCollisionCreateFunc(BOX_SHAPE_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE, &before);
  {
    const auto cairn = installOn(w);
    btRigidBody& body = addCubeOnBox(w);
    w.step(2);
    EXPECT_EQ(before.calls, 0);
    w.remove(body);
    w.dispatcher.registerCollisionCreateFunc(FAST_CONCAVE_MESH_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE, &after);
    w.dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE, &after);
  }
  addCubeOnBox(w);
  w.add(std::make_shared<btSphereShape>(btScalar(0.3)), 1, btVector3(btScalar(0.7), 0, btScalar(0.5)));
  w.step(2);
  EXPECT_GE(before.calls, 1) << "entered before: given back";
  EXPECT_GE(after.calls, 1) << "entered since: left alone";
}

// GImpact enters itself into the row of its type; what we cannot answer there is still its own.
TEST_P(Installed, LeavesToGImpactWhatItCannotAnswer) {
  StockWorld w;
  btGImpactCollisionAlgorithm::registerAlgorithm(&w.dispatcher);
  const auto cairn = installOn(w);
  auto ground = std::make_shared<btGImpactCompoundShape>();
  btBoxShape box(btVector3(3, 3, 1));
  ground->addChildShape(btTransform::getIdentity(), &box);
  ground->updateBound();
  w.add(ground, 0, btVector3(0, 0, -1));
  const btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2))), 1, btVector3(0, 0, btScalar(0.3)));
  w.step(60);
  EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0) << "GImpact takes the tree's triangles";
}

// Its registration may come after ours, and is not about trees: a block slides down a mesh of GImpact's as down any
// other. Only who knows where a step begins can see to that.
CAIRN_FRONT_END_SUITE(RegisteredFirst, StepFrontEnds);

TYPED_TEST(RegisteredFirst, ATreeIsNotLeftToGImpact) {
  BulletWorld<TypeParam> w;
  btGImpactCollisionAlgorithm::registerAlgorithm(&w.dispatcher);
  w.add(flatGround(TriangleGround::gimpact), 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2))), 1, btVector3(0, 0, btScalar(0.25)));
  w.step(2);
  EXPECT_GT(w.dispatcher.lastStep().contacts, 0U);
  w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 1, btVector3(5, 5, btScalar(0.99)));
  w.step(2);
  EXPECT_GT(w.dispatcher.getNumManifolds(), 1) << "its own pairs stay GImpact's";
}

int gNear = 0, gPreTicks = 0, gTicks = 0;
const btCollisionObject* gUnwanted = nullptr;

void filteringNearCallback(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  ++gNear;
  if (pair.m_pProxy0->m_clientObject == gUnwanted || pair.m_pProxy1->m_clientObject == gUnwanted) return;
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

struct CountingAction final : btActionInterface {
  int calls = 0;
  void updateAction(btCollisionWorld*, btScalar) override { ++calls; }
  void debugDraw(btIDebugDraw*) override {}
};

struct CountingDrawer final : btIDebugDraw {
  int points = 0;
  void drawLine(const btVector3&, const btVector3&, const btVector3&) override {}
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override { ++points; }
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return DBG_DrawContactPoints; }
};

TEST_P(Installed, LeavesTheUsersOwnHooksAlone) {
  for (const bool hooksFirst : {true, false}) {
    StockWorld w;
    CountingAction action;
    CountingDrawer drawer;
    int info = 0;
    const auto setHooks = [&] {
      w.dispatcher.setNearCallback(filteringNearCallback);
      w.world.setInternalTickCallback([](btDynamicsWorld*, btScalar) { ++gPreTicks; }, &info, true);
      w.world.setInternalTickCallback([](btDynamicsWorld*, btScalar) { ++gTicks; }, &info, false);
      w.world.addAction(&action);
      w.world.setDebugDrawer(&drawer);
    };
    gNear = gPreTicks = gTicks = 0;
    if (hooksFirst) setHooks();
    std::optional<NarrowPhase> cairn = installOn(w).value();
    if (!hooksFirst) setHooks();
    btConstraintSolver* const solver = w.world.getConstraintSolver();
    addCubeOnBox(w);
    btRigidBody& unwanted = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(2, 0, btScalar(0.5)));
    gUnwanted = &unwanted;
    w.step(60);
    EXPECT_EQ(cairn->lastStep().pairs, 1U);
    w.world.debugDrawWorld();
    EXPECT_EQ(drawer.points, 4);
    cairn.reset();
    w.step(60);
    EXPECT_GT(gNear, 120);
    EXPECT_EQ(gPreTicks, 120);
    EXPECT_EQ(gTicks, 120);
    EXPECT_EQ(action.calls, 120);
    EXPECT_EQ(w.dispatcher.getNearCallback(), &filteringNearCallback);
    EXPECT_EQ(w.world.getWorldUserInfo(), &info);
    EXPECT_EQ(w.world.getConstraintSolver(), solver);
    EXPECT_EQ(w.world.getDebugDrawer(), &drawer);
    EXPECT_LT(unwanted.getWorldTransform().getOrigin().z(), -5) << "filtered by the user";
  }
}

// Members of a class in the wrong order, say. Under the address sanitizer this says more than here.
TEST_P(Installed, MayGoAfterWorldAndDispatcher) {
  for (const bool isEmptied : {false, true}) {
    std::optional<NarrowPhase> cairn;
    auto w = std::make_unique<StockWorld>();
    cairn = installOn(*w).value();
    btRigidBody& body = addCubeOnBox(*w);
    w->step(2);
    if (isEmptied) w->remove(body);
    w.reset();
    EXPECT_EQ(cairn->lastStep().pairs, 1U);
    cairn.reset();
  }
}

// Of a world without objects nobody knows whether it lives: it is as it was when something is put into it again.
TEST(InstalledOnAWorld, LeavesAnEmptyOneAsItWasOnceSomethingComes) {
  CountingCreate before;
  StockWorld w;
  btBroadphaseInterface* const broadphase = w.world.getBroadphase();
  w.dispatcher.registerCollisionCreateFunc(FAST_CONCAVE_MESH_PROXYTYPE, BOX_SHAPE_PROXYTYPE, &before);
  w.dispatcher.registerCollisionCreateFunc(BOX_SHAPE_PROXYTYPE, FAST_CONCAVE_MESH_PROXYTYPE, &before);
  for (int i = 0; i < 3; ++i) (void)install(static_cast<btCollisionWorld&>(w.world)).value();
  addCubeOnBox(w);
  EXPECT_EQ(w.world.getBroadphase(), broadphase);
  w.step(2);
  EXPECT_GE(before.calls, 1);
}

#ifndef NDEBUG
std::optional<NarrowPhase>* gInstalled = nullptr;

TEST_P(Installed, AssertsThatItDoesNotGoInACallback) {
  StockWorld w;
  std::optional<NarrowPhase> cairn = installOn(w).value();
  addCubeOnBox(w).setCollisionFlags(btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  gInstalled = &cairn;
  gContactAddedCallback = [](btManifoldPoint&, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) {
    gInstalled->reset();
    return false;
  };
  EXPECT_DEATH(w.step(), "dispatching");
  gContactAddedCallback = nullptr;
}

TEST(InstalledOnAWorld, AssertsThatItsBroadPhaseIsNotReplaced) {
  StockWorld w;
  btDbvtBroadphase another;
  EXPECT_DEATH(
      {
        w.addGround();
        std::optional<NarrowPhase> cairn = install(static_cast<btCollisionWorld&>(w.world)).value();
        w.world.setBroadphase(&another);
        cairn.reset();
      },
      "broad phase was replaced");
}
#endif

}  // namespace
}  // namespace cairn::test::install_test
