// SPDX-License-Identifier: Zlib
// The dispatcher inside a real Bullet world: queries, compounds, foreign shapes, callbacks, ghosts, pairs that come and
// go.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btSdfCollisionShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <limits>
#include <random>

#include "counting_create.h"
#include "front_ends.h"

namespace cairn::test::dispatch_test {
namespace {

constexpr btScalar kRestTolerance = bullet::kSpeculativeFraction;

CAIRN_FRONT_END_SUITE(Queries_ContactPairTest, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Queries_ContactTest, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Queries_Compound, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Compound, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Foreign, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Callbacks, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Contacts, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Ghost, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Statistics, StepFrontEnds);
CAIRN_FRONT_END_SUITE(Dispatch_Pairs, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Errors, EveryFrontEnd);
CAIRN_FRONT_END_SUITE(Dispatch_Scale, EveryFrontEnd);

struct Points final : btCollisionWorld::ContactResultCallback {
  int count = 0;
  btScalar deepest = 1;
  btVector3 normalOnB{0, 0, 0};
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    ++count;
    if (point.getDistance() < deepest) {
      deepest = point.getDistance();
      normalOnB = point.m_normalWorldOnB;
    }
    return 0;
  }
};

TYPED_TEST(Queries_ContactPairTest, ReportsDepthAndNormalInBothOrders) {
  BulletWorld<TypeParam> w;
  btRigidBody& ground = w.addGround();
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.45)));
  for (const bool bodyFirst : {true, false}) {
    Points points;
    w.world.contactPairTest(bodyFirst ? &body : &ground, bodyFirst ? &ground : &body, points);
    EXPECT_GE(points.count, 3);
    EXPECT_NEAR(points.deepest, -0.05, 1e-4);
    EXPECT_NEAR(points.normalOnB.z(), bodyFirst ? 1 : -1, 1e-5) << "from B to A";
  }
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0) << "a query leaves nothing behind";
}

TYPED_TEST(Queries_ContactTest, FindsWhatTheBroadPhaseFinds) {
  BulletWorld<TypeParam> w;
  w.addGround();
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.5, 6))), 1, btVector3(0, 0, btScalar(0.48)));
  Points points;
  w.world.contactTest(&body, points);
  EXPECT_GE(points.count, 1);
  EXPECT_NEAR(points.deepest, -0.02, 0.001);
}

TYPED_TEST(Queries_ContactPairTest, HonoursTheDistanceThreshold) {
  BulletWorld<TypeParam> w;
  w.add(std::make_shared<btBoxShape>(btVector3(2, 2, 1)), 0, btVector3(0, 0, -1));
  btRigidBody& body = w.add(treeShape(plainTree(ball(0.5, 6))), 1, btVector3(0, 0, btScalar(0.6)));
  Points near;
  w.world.contactPairTest(&body, w.world.getCollisionObjectArray()[0], near);
  EXPECT_EQ(near.count, 0) << "10 cm apart";
  Points far;
  far.m_closestDistanceThreshold = btScalar(0.2);
  w.world.contactPairTest(&body, w.world.getCollisionObjectArray()[0], far);
  EXPECT_GE(far.count, 1);
  EXPECT_NEAR(far.deepest, 0.1, 0.005);
}

TYPED_TEST(Queries_Compound, FindTheTreeInside) {
  BulletWorld<TypeParam> w;
  btRigidBody& ground = w.addGround();
  auto compound = std::make_shared<btCompoundShape>();
  const auto child = treeShape(plainTree(cuboid({1, 1, 1}, 2)));
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 1)), child.get());
  btRigidBody& body = w.add(compound, 1, btVector3(0, 0, btScalar(-0.55)));
  Points touching;
  w.world.contactPairTest(&body, &ground, touching);
  EXPECT_GE(touching.count, 1);
  EXPECT_NEAR(touching.deepest, -0.05, 1e-4);
}

TYPED_TEST(Dispatch_Compound, ChildTreeRestsOnPlaneAndTree) {
  for (const bool onTree : {false, true}) {
    BulletWorld<TypeParam> w;
    if (onTree)
      w.add(treeShape(plainTree(cuboid({4, 4, 1}, 6))), 0, btVector3(0, 0, btScalar(-0.5)));
    else
      w.addGround();
    auto compound = std::make_shared<btCompoundShape>();
    const auto child = treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 3)));
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(-0.3), 0, 0)), child.get());
    compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.3), 0, 0)), child.get());
    btRigidBody& body = w.add(compound, 2, btVector3(0, 0, btScalar(0.3)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(180);
    ASSERT_TRUE(isSane(body));
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.25, kRestTolerance) << "on tree " << onTree;
    EXPECT_EQ(w.dispatcher.lastStep().pairs, 2U) << "one for each child";
  }
}

// Compounds against each other dispatch with a result whose bodies may stand the other way round.
TYPED_TEST(Dispatch_Compound, TwoCompoundsOfTreesStack) {
  BulletWorld<TypeParam> w;
  w.addGround();
  const auto child = treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 3)));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 2; ++i) {
    auto compound = std::make_shared<btCompoundShape>();
    compound->addChildShape(btTransform::getIdentity(), child.get());
    bodies.push_back(&w.add(compound, 1, btVector3(0, 0, btScalar(0.26 + 0.52 * i))));
  }
  w.step(240);
  EXPECT_NEAR(bodies[0]->getWorldTransform().getOrigin().z(), 0.25, kRestTolerance);
  EXPECT_NEAR(bodies[1]->getWorldTransform().getOrigin().z(), 0.75, 2 * kRestTolerance);
}

TEST(Dispatch_Unregistered, BoxStillMeetsTheTriangles) {
  BulletWorld<btCollisionDispatcher> w;
  w.add(std::make_shared<btBoxShape>(btVector3(3, 3, 1)), 0, btVector3(0, 0, -1));
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2))), 1, btVector3(0, 0, btScalar(0.3)));
  w.step(120);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.25, 0.05)
      << "Bullet's own triangle contacts, with its margins";
}

TYPED_TEST(Dispatch_Foreign, ShapeOfOurTypeKeepsBulletsAlgorithm) {
  struct Foreign final : btBvhTriangleMeshShape {
    explicit Foreign(btStridingMeshInterface* mesh) : btBvhTriangleMeshShape(mesh, true) {
      m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
    }
  };
  btTriangleMesh mesh;
  mesh.addTriangle(btVector3(-9, -9, 0), btVector3(9, -9, 0), btVector3(0, 9, 0));
  BulletWorld<TypeParam> w;
  w.add(std::make_shared<Foreign>(&mesh), 0, btVector3(0, 0, 0));
  btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 1, btVector3(0, 0, btScalar(1.1)));
  btRigidBody& tree = w.add(treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 2))), 1, btVector3(2, 0, btScalar(0.3)));
  w.step(120);
  EXPECT_NEAR(box.getWorldTransform().getOrigin().z(), 1, 0.06) << "Bullet's own algorithm, with its margins";
  EXPECT_NEAR(tree.getWorldTransform().getOrigin().z(), 0.25, kRestTolerance) << "ours, on its triangles";
  EXPECT_EQ(w.dispatcher.lastStep().pairs, 1U);
}

int gAdded = 0, gStarted = 0, gEnded = 0, gProcessed = 0;

TYPED_TEST(Dispatch_Callbacks, StartOnceWhileABodyRests) {
  gContactAddedCallback = [](btManifoldPoint&, const btCollisionObjectWrapper*, int part0, int index0,
                             const btCollisionObjectWrapper*, int, int) {
    gAdded += part0 >= 0 && index0 >= 0;
    return false;
  };
  gContactStartedCallback = [](btPersistentManifold* const&) { ++gStarted; };
  gContactEndedCallback = [](btPersistentManifold* const&) { ++gEnded; };
  gContactProcessedCallback = [](btManifoldPoint&, void*, void*) {
    ++gProcessed;
    return false;
  };
  gAdded = gStarted = gEnded = gProcessed = 0;
  {
    BulletWorld<TypeParam> w;
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.501)));
    w.addGround();
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    w.step(60);
    EXPECT_EQ(gStarted, 1);
    EXPECT_EQ(gEnded, 0);
    EXPECT_GE(gAdded, 3 * 60) << "part and index lead back to the tree's level and leaf";
    EXPECT_GE(gProcessed, 3 * 50);
  }
  EXPECT_EQ(gEnded, 1) << "released with the world";
  gContactAddedCallback = nullptr;
  gContactStartedCallback = nullptr;
  gContactEndedCallback = nullptr;
  gContactProcessedCallback = nullptr;
}

TYPED_TEST(Dispatch_Contacts, KeepTheirImpulses) {
  BulletWorld<TypeParam> w;
  w.addGround();
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
  body.setActivationState(DISABLE_DEACTIVATION);
  w.step(120);
  ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
  const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(0);
  ASSERT_EQ(m.getNumContacts(), 4);
  btScalar sum = 0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(m.getContactPoint(i).getLifeTime(), 60) << "the same four points all along";
    sum += m.getContactPoint(i).getAppliedImpulse();
  }
  EXPECT_NEAR(sum, 9.81 / 60, 0.02);
}

TYPED_TEST(Dispatch_Ghost, CharacterLooksAroundWithoutSpendingTheStep) {
  btGhostPairCallback pairs;  // outlives the broad phase that is told of it
  BulletWorld<TypeParam> w;
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
  w.addGround();
  w.world.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
  btPairCachingGhostObject ghost;
  btSphereShape sphere(btScalar(0.5));
  ghost.setCollisionShape(&sphere);
  ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.9), 0, btScalar(0.5))));
  w.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
  ASSERT_TRUE(w.dispatcher.setBudget({0, {}}).ok());
  w.step(3);
  const auto before = w.dispatcher.lastStep();
  w.dispatcher.dispatchAllCollisionPairs(ghost.getOverlappingPairCache(), w.world.getDispatchInfo(), &w.dispatcher);
  btManifoldArray manifolds;
  for (int i = 0; i < ghost.getOverlappingPairCache()->getNumOverlappingPairs(); ++i) {
    btBroadphasePair& pair = ghost.getOverlappingPairCache()->getOverlappingPairArray()[i];
    if (pair.m_algorithm) pair.m_algorithm->getAllContactManifolds(manifolds);
  }
  int contacts = 0;
  for (int i = 0; i < manifolds.size(); ++i)
    if (manifolds[i]->getBody0() == &body || manifolds[i]->getBody1() == &body)
      contacts += manifolds[i]->getNumContacts();
  EXPECT_GE(contacts, 1) << "answered in full although the step's budget is 0";
  EXPECT_EQ(w.dispatcher.lastStep().operations, before.operations) << "the step's statistics are not the ghost's";
  w.world.removeCollisionObject(&ghost);
}

TYPED_TEST(Dispatch_Ghost, CharacterWithNothingAroundLeavesTheStatistics) {
  btGhostPairCallback pairs;
  BulletWorld<TypeParam> w;
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
  w.add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, -1));
  w.world.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
  btPairCachingGhostObject ghost;
  btSphereShape sphere(btScalar(0.5));
  ghost.setCollisionShape(&sphere);
  ghost.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(50, 0, 50)));
  w.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
  w.step(2);
  ASSERT_EQ(ghost.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  const auto before = w.dispatcher.lastStep();
  w.dispatcher.dispatchAllCollisionPairs(ghost.getOverlappingPairCache(), w.world.getDispatchInfo(), &w.dispatcher);
  EXPECT_EQ(w.dispatcher.lastStep().pairs, 1U);
  EXPECT_EQ(w.dispatcher.lastStep().operations, before.operations);
  EXPECT_EQ(w.dispatcher.lastStep().contacts, before.contacts);
  w.world.removeCollisionObject(&ghost);
}

TYPED_TEST(Dispatch_Statistics, AreThoseOfAWorldThatBecameEmpty) {
  BulletWorld<TypeParam> w;
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.5)));
  w.addGround();
  w.step(2);
  ASSERT_EQ(w.dispatcher.lastStep().pairs, 1U);
  w.remove(body);
  w.step();
  EXPECT_EQ(w.dispatcher.lastStep().pairs, 0U);
}

// A shape without triangles is left to its own algorithm.
struct ConfigurationWithSdf final : btDefaultCollisionConfiguration {
  CountingCreate create;
  btCollisionAlgorithmCreateFunc* getCollisionAlgorithmCreateFunc(int type0, int type1) override {
    const auto isTheirs = [](int type) { return type == GIMPACT_SHAPE_PROXYTYPE || type == SDF_SHAPE_PROXYTYPE; };
    if (isTheirs(type0) || isTheirs(type1)) return &create;
    return btDefaultCollisionConfiguration::getCollisionAlgorithmCreateFunc(type0, type1);
  }
};

TEST(Dispatch_WithoutTriangles, IsLeftToTheConfiguration) {
  ConfigurationWithSdf configuration;
  bullet::Dispatcher<> dispatcher(&configuration);
  const auto tree = treeShape(plainTree(cuboid({1, 1, 1}, 2)));
  btSdfCollisionShape sdf;
  btGImpactCompoundShape compound;
  btTriangleMesh mesh;
  mesh.addTriangle(btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0));
  btGImpactMeshShape gimpactMesh(&mesh);
  const auto callsFor = [&](const btCollisionShape& shape) {
    configuration.create.calls = 0;
    const btTransform identity = btTransform::getIdentity();
    btCollisionObject body0, body1;
    const btCollisionObjectWrapper wrapper0(nullptr, tree.get(), &body0, identity, -1, -1);
    const btCollisionObjectWrapper wrapper1(nullptr, &shape, &body1, identity, -1, -1);
    for (const bool treeFirst : {true, false}) {
      btCollisionAlgorithm* algorithm = dispatcher.findAlgorithm(
          treeFirst ? &wrapper0 : &wrapper1, treeFirst ? &wrapper1 : &wrapper0, nullptr, BT_CONTACT_POINT_ALGORITHMS);
      algorithm->~btCollisionAlgorithm();
      dispatcher.freeCollisionAlgorithm(algorithm);
    }
    return configuration.create.calls;
  };
  EXPECT_EQ(callsFor(sdf), 0) << "is met as a field, whatever the configuration has for it";
  EXPECT_EQ(callsFor(compound), 2);
  EXPECT_EQ(callsFor(gimpactMesh), 0) << "has triangles";
}

TYPED_TEST(Dispatch_Pairs, ComeAndGoAtRandom) {
  std::mt19937_64 engine(5);
  BulletWorld<TypeParam> w;
  w.addGround();
  w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 0, btVector3(0, 0, 0));
  const auto tree = plainTree(ball(0.3, 4));
  std::vector<btRigidBody*> bodies;
  ASSERT_TRUE(w.dispatcher.setBudget({3000, {}}).ok());
  const auto number = [&] { return btScalar(engine() % 1000) / 500 - 1; };
  for (int step = 0; step < 300; ++step) {
    if (bodies.size() < 25) bodies.push_back(&w.add(treeShape(tree), 1, btVector3(number(), number(), 1 + number())));
    if (engine() % 3 == 0) {
      const std::size_t k = engine() % bodies.size();
      w.remove(*bodies[k]);
      bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(k));
    }
    w.step();
    for (btRigidBody* body : bodies) ASSERT_TRUE(isSane(*body)) << "step " << step;
  }
  while (!bodies.empty()) {
    w.remove(*bodies.back());
    bodies.pop_back();
  }
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0);
}

TYPED_TEST(Dispatch_Errors, RefuseImpossibleBudgets) {
  BulletWorld<TypeParam> w;
  EXPECT_FALSE(w.dispatcher.setBudget({-1, {}}).ok());
  EXPECT_FALSE(w.dispatcher.setBudget({{}, -0.5}).ok());
  const Status nan = w.dispatcher.setBudget({{}, std::numeric_limits<double>::quiet_NaN()});
  ASSERT_FALSE(nan.ok());
  EXPECT_NE(nan.error().message.find("microseconds"), std::string::npos);
  EXPECT_TRUE(w.dispatcher.setBudget({0, 0.0}).ok());
  EXPECT_TRUE(w.dispatcher.setBudget({}).ok());
}

TYPED_TEST(Dispatch_Scale, SameBodyAtEveryScaleRestsOnItsMesh) {
  for (const double scale : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    BulletWorld<TypeParam> w;
    w.world.setGravity(btVector3(0, 0, btScalar(-9.81 * scale)));  // the same motion, seen from farther away
    w.addGround();
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 3)), btScalar(scale)), 1,
                              btVector3(0, 0, btScalar(0.25 * scale)));
    body.setSleepingThresholds(0, 0);
    w.step(180);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z() / btScalar(scale), 0.2, kRestTolerance) << "scale " << scale;
  }
}

}  // namespace
}  // namespace cairn::test::dispatch_test
