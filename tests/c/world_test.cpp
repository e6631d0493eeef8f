// SPDX-License-Identifier: Zlib
//
// Worlds in C: the bits of the same world in C++, and every value out of range refused in a sentence.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "bullet_world.h"
#include "c_world.h"

namespace cairn::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

// The same heap by Bullet's own interface.
std::string hashOfTheSameInCpp(const SphereTree& tree, int bodies, std::int64_t operations, int steps) {
  auto shape = std::shared_ptr(bullet::SphereTreeShape::create(std::make_shared<const SphereTree>(tree)).value());
  BulletWorld<> world;
  world.world.setGravity(btVector3(0, btScalar(-9.81F), 0));
  EXPECT_TRUE(world.dispatcher.setBudget({operations, {}}));
  const btRigidBody& floor =
      world.add(std::make_shared<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0)), 0, {0, 0, 0});
  std::vector<const btRigidBody*> all{&floor};
  for (int i = 0; i < bodies; ++i) {
    const btTransform mesh(btQuaternion::getIdentity(),
                           btVector3(btScalar(0.1F * float(i % 3)), btScalar(1 + float(i)), btScalar(0)));
    btRigidBody& body = world.add(shape, 1, {0, 0, 0});
    body.setWorldTransform(mesh * shape->bodyFromMesh().inverse());
    body.setInterpolationWorldTransform(body.getWorldTransform());
    world.world.updateSingleAabb(&body);
    all.push_back(&body);
  }
  for (int i = 0; i < steps; ++i) world.world.stepSimulation(btScalar(1.0F / 60), 0);
  StateHash hash;
  for (const btRigidBody* body : all) addState(hash, *body);
  return hash.hex();
}

TEST(CWorld, MovesOnWithTheBitsOfCpp) {
  const auto tree = plainTree(torus(0.35, 0.12, 16));
  HeapInC heap(*tree, 8);
  const CairnBudget budget = {3000, CAIRN_NO_LIMIT};
  ASSERT_EQ(cairnSetBudget(heap.world.get(), &budget), 1);
  heap.step(200);
  char hash[17];
  cairnStateHash(heap.world.get(), hash);
  EXPECT_EQ(hash, hashOfTheSameInCpp(*tree, 8, 3000, 200));
}

TEST(CWorld, BodiesThatSleptFallByANewGravity) {
  HeapInC heap(*plainTree(cuboid({0.5, 0.4, 0.3}, 3)), 1);
  for (int i = 0; i < 2000 && cairnIsAsleep(heap.world.get(), 0) != 1; ++i) heap.step(1);
  ASSERT_EQ(cairnIsAsleep(heap.world.get(), 0), 1);
  const float upwards[3] = {0, 9.81F, 0};
  ASSERT_EQ(cairnSetGravity(heap.world.get(), upwards), 1);
  CairnPose before, after;
  cairnGetPose(heap.world.get(), 0, &before);
  heap.step(60);
  cairnGetPose(heap.world.get(), 0, &after);
  EXPECT_GT(after.position[1] - before.position[1], 4) << "a second of 9.81 m/s^2 makes 4.9 m";
}

TEST(CWorld, TellsItsContactsWithItsStatistics) {
  HeapInC heap(*plainTree(cuboid({0.5, 0.4, 0.3}, 3)), 4);
  std::set<int> touched;
  for (int i = 0; i < 110; ++i) {  // before anything sleeps, as what sleeps is not counted
    heap.step(1);
    CairnStatistics statistics;
    cairnLastStep(heap.world.get(), &statistics);
    EXPECT_EQ(statistics.deadlineMicroseconds, CAIRN_NO_LIMIT);
    std::vector<CairnContact> contacts(cairnContacts(heap.world.get(), nullptr, 0) + 1);
    contacts.resize(cairnContacts(heap.world.get(), contacts.data(), contacts.size()));
    ASSERT_EQ(contacts.size(), statistics.contacts) << "step " << i;
    for (const CairnContact& c : contacts) {
      EXPECT_NEAR(std::hypot(c.normal[0], c.normal[1], c.normal[2]), 1, 1e-5);
      EXPECT_GE(c.error, 0);
      touched.insert({c.a, c.b});
    }
  }
  EXPECT_EQ(touched, (std::set<int>{-1, 0, 1, 2, 3}));
}

TEST(CWorld, TellsWhichContactsAreOfUnfinishedPairs) {
  HeapInC heap(*plainTree(torus(0.35, 0.12, 16)), 6);
  const CairnBudget tiny = {300, CAIRN_NO_LIMIT};
  const auto unfinished = [&] {
    std::vector<CairnContact> contacts(cairnContacts(heap.world.get(), nullptr, 0));
    cairnContacts(heap.world.get(), contacts.data(), contacts.size());
    return std::ranges::count_if(contacts, [](const CairnContact& c) { return c.isResolved == 0; });
  };
  heap.step(90);
  EXPECT_EQ(unfinished(), 0) << "without a budget";
  ASSERT_EQ(cairnSetBudget(heap.world.get(), &tiny), 1);
  CairnStatistics statistics = {};
  std::ptrdiff_t seen = 0;
  for (int i = 0; i < 60; ++i) {
    const float push[3] = {1, 1, 0}, spin[3] = {0, 1, 1};
    ASSERT_EQ(cairnSetVelocity(heap.world.get(), i % 6, push, spin), 1);
    heap.step(1);
    cairnLastStep(heap.world.get(), &statistics);
    if (statistics.unresolvedPairs == 0) EXPECT_EQ(unfinished(), 0);
    seen += unfinished();
  }
  EXPECT_GT(seen, 0);
}

TEST(CWorld, GivesNumbersOfRemovedBodiesAgain) {
  HeapInC heap(*plainTree(ball(0.4, 2)), 3);
  CairnWorld* const world = heap.world.get();
  EXPECT_EQ(cairnRemoveBody(world, 1), 1);
  EXPECT_EQ(cairnRemoveBody(world, 1), 0) << "it is gone";
  EXPECT_EQ(cairnBodyCount(world), 3);
  EXPECT_EQ(cairnIsAsleep(world, 1), -1);
  heap.step(10);
  EXPECT_EQ(cairnAddBody(world, heap.shape.get(), 1, &kAtOrigin, nullptr), 1);
  EXPECT_EQ(cairnIsAsleep(world, 1), 0);
}

TEST(CWorld, PutsBodiesWhereTheirMeshIsTold) {
  HeapInC heap(*plainTree(cuboid({1, 0.3, 0.3}, 3)), 1);
  const float r = std::sqrt(0.5F);
  const CairnPose pose = {{1, 2, 3}, {r, 0, 0, r}};
  ASSERT_EQ(cairnSetPose(heap.world.get(), 0, &pose), 1);
  CairnPose told;
  ASSERT_EQ(cairnGetPose(heap.world.get(), 0, &told), 1);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(told.position[i], pose.position[i], 1e-5);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(told.rotation[i], pose.rotation[i], 1e-5);
  const float linear[3] = {1, 0, 0}, angular[3] = {0, 2, 0};
  ASSERT_EQ(cairnSetVelocity(heap.world.get(), 0, linear, angular), 1);
  float toldLinear[3], toldAngular[3];
  ASSERT_EQ(cairnGetVelocity(heap.world.get(), 0, toldLinear, toldAngular), 1);
  EXPECT_EQ(toldLinear[0], 1);
  EXPECT_EQ(toldAngular[1], 2);
}

TEST(CWorld, DragsABodyToItsTarget) {
  HeapInC heap(*plainTree(ball(0.4, 2)), 1);
  const float held[3] = {0, 0, 0}, target[3] = {0.5F, 3, 0};
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(cairnDragBody(heap.world.get(), 0, held, target), 1) << cairnError();
    heap.step(1);
  }
  CairnPose pose;
  ASSERT_EQ(cairnGetPose(heap.world.get(), 0, &pose), 1);
  EXPECT_NEAR(pose.position[1], 3, 0.05);
  ASSERT_EQ(cairnReleaseBody(heap.world.get(), 0), 1);
  heap.step(120);
  ASSERT_EQ(cairnGetPose(heap.world.get(), 0, &pose), 1);
  EXPECT_LT(pose.position[1], 1) << "it was let go";
}

TEST(CWorld, DragsWithABoundedPull) {
  HeapInC heap(*plainTree(ball(0.4, 2)), 1);
  const float held[3] = {0, 0, 0}, target[3] = {1000, 1, 0};
  ASSERT_EQ(cairnDragBody(heap.world.get(), 0, held, target), 1);
  heap.step(1);
  float linear[3], angular[3];
  ASSERT_EQ(cairnGetVelocity(heap.world.get(), 0, linear, angular), 1);
  EXPECT_NEAR(linear[0], 200.0F / 60, 0.05F);
}

TEST(CWorld, RefusesWhatIsOutOfRange) {
  HeapInC heap(*plainTree(ball(0.4, 2)), 1);
  CairnWorld* const w = heap.world.get();
  const float zero[3] = {0, 0, 0}, bad[3] = {0, kNan, 0}, flat[3] = {1, 0, 1}, far[3] = {0, kInfinity, 0};
  const float up[3] = {0, 1, 0}, tiny[3] = {1e-20F, 1e-20F, 1e-20F}, huge[3] = {1e30F, 0, 0};
  const CairnPose badPlace = at(kNan, 0, 0), noRotation = {{0, 0, 0}, {0, 0, 0, 0}};
  const CairnBudget negative = {-5, CAIRN_NO_LIMIT}, nanTime = {CAIRN_NO_LIMIT, kNan};
  const CairnMaterial rough = {-1, 0};
  const auto add = [&](float mass, const CairnPose& pose, const CairnMaterial* material) {
    return cairnAddBody(w, heap.shape.get(), mass, &pose, material) >= 0 ? 1 : 0;
  };
  const std::vector<std::function<int()>> calls{
      [&] { return cairnSetGravity(w, bad); },
      [&] { return cairnSetBudget(w, &negative); },
      [&] { return cairnSetBudget(w, &nanTime); },
      [&] { return cairnSetUnresolved(w, 9); },
      [&] { return cairnSetUnresolved(w, -1); },
      [&] { return cairnSetFinest(w, 2); },
      [&] { return cairnAddPlane(w, zero, 0, nullptr); },
      [&] { return cairnAddPlane(w, far, 0, nullptr); },
      [&] { return cairnAddBox(w, flat, &kAtOrigin, nullptr); },
      [&] { return add(-1, kAtOrigin, nullptr); },
      [&] { return add(kNan, kAtOrigin, nullptr); },
      [&] { return add(1e-44F, kAtOrigin, nullptr); },
      [&] { return add(1e12F, kAtOrigin, nullptr); },
      [&] { return add(1, at(0, 1e20F, 0), nullptr); },
      [&] { return cairnAddPlane(w, up, 1e38F, nullptr); },
      [&] { return cairnAddPlane(w, tiny, 0, nullptr); },
      [&] { return cairnAddBox(w, tiny, &kAtOrigin, nullptr); },
      [&] { return cairnSetGravity(w, huge); },
      [&] { return cairnSetVelocity(w, 0, huge, zero); },
      [&] { return cairnDragBody(w, 0, zero, huge); },
      [&] { return add(1, badPlace, nullptr); },
      [&] { return add(1, noRotation, nullptr); },
      [&] { return add(1, kAtOrigin, &rough); },
      [&] { return cairnRemoveBody(w, 1); },
      [&] { return cairnRemoveBody(w, -1); },
      [&] { return cairnSetPose(w, 0, &badPlace); },
      [&] { return cairnSetVelocity(w, 0, zero, bad); },
      [&] { return cairnDragBody(w, 0, zero, bad); },
      [&] { return cairnReleaseBody(w, 7); },
  };
  char before[17], after[17];
  cairnStateHash(w, before);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    EXPECT_EQ(calls[i](), 0) << "call " << i;
    EXPECT_GT(std::string(cairnError()).size(), 20U) << "call " << i;
  }
  cairnStateHash(w, after);
  EXPECT_STREQ(before, after) << "a refused call changed the world";
  CairnWorldOptions options = cairnUsualWorld();
  for (const float step : {0.0F, 1e-9F, 10.0F}) {
    options.timeStep = step;
    EXPECT_EQ(cairnMakeWorld(&options), nullptr) << step;
  }
  options = cairnUsualWorld();
  for (const int iterations : {0, 1'000'000}) {
    options.solverIterations = iterations;
    EXPECT_EQ(cairnMakeWorld(&options), nullptr) << iterations;
  }
}

}  // namespace
}  // namespace cairn::test
