// SPDX-License-Identifier: Zlib
// Shapes replaced and bodies removed while the narrow phase holds on to them.
#include <gtest/gtest.h>

#include "front_ends.h"

namespace cairn::test::lifetime_test {
namespace {

int contactsOf(btDispatcher& dispatcher) {
  int contacts = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
    contacts += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  return contacts;
}

// Two cubes of one metre side by side, overlapping by a tenth; their traversal is stopped half-way.
template <class FrontEnd>
struct UnfinishedPair {
  BulletWorld<FrontEnd> w;
  std::unique_ptr<bullet::SphereTreeShape> shape;
  std::weak_ptr<const SphereTree> tree;
  btRigidBody* body = nullptr;

  explicit UnfinishedPair(bool replacedIsFirst) {
    w.world.setGravity(btVector3(0, 0, 0));
    auto owned = std::make_shared<const SphereTree>(cuboidTree(12));
    tree = owned;
    shape = bullet::SphereTreeShape::create(std::move(owned), bullet::BodyFrame::mesh).value();
    // The world must not own what the test destroys.
    const std::shared_ptr<btCollisionShape> borrowed(shape.get(), [](btCollisionShape*) {});
    const auto addOther = [&] { w.add(treeShape(plainTree(cuboid({1, 1, 1}, 12))), 0, btVector3(0, 0, 0)); };
    if (!replacedIsFirst) addOther();
    body = &w.add(borrowed, 1, btVector3(btScalar(0.9), 0, 0));
    if (replacedIsFirst) addOther();
    EXPECT_TRUE(w.dispatcher.setBudget({200, {}}).ok());
    w.world.performDiscreteCollisionDetection();
    w.world.performDiscreteCollisionDetection();
    EXPECT_EQ(w.dispatcher.lastStep().unresolvedPairs, 1U) << "the budget was no limit: the test shows nothing";
  }
  static SphereTree cuboidTree(int cells) {
    return SphereTree::create(plainTree(cuboid({1, 1, 1}, cells))->data()).value();
  }
};

CAIRN_FRONT_END_SUITE(ReplacedShape, EveryFrontEnd);

TYPED_TEST(ReplacedShape, StartsAnewWithAnotherTree) {
  for (const bool isFirst : {false, true}) {
    UnfinishedPair<TypeParam> pair(isFirst);
    const auto small = treeShape(plainTree(cuboid({0.5, 0.5, 0.5}, 1)));
    pair.body->setCollisionShape(small.get());
    pair.shape.reset();
    EXPECT_FALSE(pair.tree.expired()) << "the unfinished traversal still refers to it";
    ASSERT_TRUE(pair.w.dispatcher.setBudget({}).ok());
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_TRUE(pair.tree.expired()) << "nobody refers to it any more";
    EXPECT_EQ(pair.w.dispatcher.lastStep().unresolvedPairs, 0U);
    EXPECT_EQ(contactsOf(pair.w.dispatcher), 0) << "the new shape is 15 cm away";

    pair.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.74), 0, 0)));
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_GE(contactsOf(pair.w.dispatcher), 3) << "and now it touches";
  }
}

TYPED_TEST(ReplacedShape, LeavesNoStaleContactsOfAnotherKind) {
  for (const bool isFirst : {false, true}) {
    UnfinishedPair<TypeParam> pair(isFirst);
    ASSERT_TRUE(pair.w.dispatcher.setBudget({}).ok());
    pair.w.world.performDiscreteCollisionDetection();
    ASSERT_GE(contactsOf(pair.w.dispatcher), 3);
    btBoxShape small(btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2)));
    pair.body->setCollisionShape(&small);
    pair.shape.reset();
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_EQ(contactsOf(pair.w.dispatcher), 0) << "the box is 20 cm away";
    EXPECT_EQ(pair.w.dispatcher.lastStep().pairs, 1U);

    pair.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(0.69), 0, 0)));
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_GE(contactsOf(pair.w.dispatcher), 3);

    const auto back = treeShape(plainTree(cuboid({0.4, 0.4, 0.4}, 3)));
    pair.body->setCollisionShape(back.get());
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_GE(contactsOf(pair.w.dispatcher), 3) << "box to tree";
    pair.body->setCollisionShape(&small);  // outlives the world, unlike `back`
  }
}

TYPED_TEST(ReplacedShape, ForgetsItsContactsWhenNothingIsLeftToMeet) {
  for (const bool isFirst : {false, true}) {
    UnfinishedPair<TypeParam> pair(isFirst);
    ASSERT_TRUE(pair.w.dispatcher.setBudget({}).ok());
    pair.w.world.performDiscreteCollisionDetection();
    ASSERT_GE(contactsOf(pair.w.dispatcher), 3);
    btCompoundShape empty;
    pair.body->setCollisionShape(&empty);
    pair.w.world.performDiscreteCollisionDetection();
    EXPECT_EQ(contactsOf(pair.w.dispatcher), 0);
    EXPECT_EQ(pair.w.dispatcher.lastStep().pairs, 0U);
  }
}

struct Removal {
  btDiscreteDynamicsWorld* world = nullptr;
  btRigidBody* victim = nullptr;
  bool isDone = false;
};
Removal gRemoval;

bool removeVictim(btManifoldPoint&, const btCollisionObjectWrapper* a, int, int, const btCollisionObjectWrapper* b, int,
                  int) {
  const btRigidBody* victim = gRemoval.victim;
  if (gRemoval.isDone || a->getCollisionObject() == victim || b->getCollisionObject() == victim) return false;
  gRemoval.isDone = true;
  gRemoval.world->removeRigidBody(gRemoval.victim);
  return false;
}

CAIRN_FRONT_END_SUITE(RemovedBody_InAContactCallback, EveryFrontEnd);

TYPED_TEST(RemovedBody_InAContactCallback, IsNamedByNoManifold) {
  BulletWorld<TypeParam> w;
  w.addGround();
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < 6; ++i) {
    bodies.push_back(&w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1,
                            btVector3(btScalar(1.2) * btScalar(i), 0, btScalar(0.5))));
    bodies.back()->setCollisionFlags(bodies.back()->getCollisionFlags() |
                                     btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  }
  gRemoval = {&w.world, bodies.back(), false};
  gContactAddedCallback = removeVictim;
  w.world.performDiscreteCollisionDetection();
  gContactAddedCallback = nullptr;
  ASSERT_TRUE(gRemoval.isDone);
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
    EXPECT_TRUE(m.getBody0() != bodies.back() && m.getBody1() != bodies.back());
  }
  EXPECT_EQ(w.dispatcher.lastStep().manifolds, 5U);
  w.world.addRigidBody(bodies.back());
  w.step(30);
  EXPECT_NEAR(bodies.back()->getWorldTransform().getOrigin().z(), 0.5, bullet::kSpeculativeFraction);
}

}  // namespace
}  // namespace cairn::test::lifetime_test
