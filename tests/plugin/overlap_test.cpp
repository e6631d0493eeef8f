// SPDX-License-Identifier: Zlib
// Whether a place is free, and bodies that were put inside each other.
#include "cairn/bullet/overlap.h"

#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"

namespace cairn::test::overlap_test {
namespace {

constexpr unsigned kSeed = 46;

btTransform at(btScalar x, btScalar y, btScalar z) {
  return btTransform(btQuaternion::getIdentity(), btVector3(x, y, z));
}

// Cubes of a metre, where the depth is known: what one coordinate says.
TEST(OverlapAt, TellsTheDeepestAndItsWayOut) {
  BulletWorld<> w;
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  const btRigidBody& near = w.add(cube, 1, btVector3(0, 0, 0));
  w.add(cube, 1, btVector3(btScalar(1.97), 0, 0));
  const auto overlap = bullet::overlapAt(w.world, *cube, at(btScalar(0.99), btScalar(0.002), btScalar(0.001)));
  ASSERT_TRUE(overlap.has_value());
  EXPECT_EQ(overlap->count, 2);
  const auto one = bullet::overlapAt(w.world, *cube, at(btScalar(0.95), 0, 0), btScalar(0.03));
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(one->with, &near);
  EXPECT_EQ(one->count, 1);
  EXPECT_NEAR(one->depth, 0.05, 0.01);
  EXPECT_GT(one->direction.x(), 0.9) << "away from the one it is in";
  EXPECT_FALSE(bullet::overlapAt(w.world, *cube, at(0, btScalar(1.01), 0)).has_value());
  EXPECT_EQ(w.world.getNumCollisionObjects(), 2) << "asking puts nothing into the world";
}

TEST(OverlapAt, PassesOverWhatDoesNotAnswerAndWhatIsMasked) {
  BulletWorld<> w;
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  btRigidBody& body = w.add(cube, 1, btVector3(0, 0, 0));
  EXPECT_TRUE(bullet::overlapAt(w.world, *cube, at(btScalar(0.9), 0, 0)).has_value());
  EXPECT_FALSE(bullet::overlapAt(w.world, *cube, at(btScalar(0.9), 0, 0), 0, btBroadphaseProxy::StaticFilter));
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  EXPECT_FALSE(bullet::overlapAt(w.world, *cube, at(btScalar(0.9), 0, 0)).has_value());
}

// Rings that pass through each other as a spawner in a hurry leaves them.
struct Tangle {
  BulletWorld<> w;
  std::vector<btRigidBody*> rings;

  explicit Tangle(int count) {
    w.addGround();
    const auto ring = treeShape(plainTree(torus(0.36, 0.09, 16)));
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < count; ++i) {
      const double x = u(random), y = u(random), z = u(random), a = u(random), b = u(random);
      rings.push_back(&w.add(ring, 1, btVector3(btScalar(0.3 * x), btScalar(0.3 * y), btScalar(1 + 0.3 * z)),
                             btQuaternion(btScalar(a), btScalar(b), btScalar(0.3), 1).normalized()));
    }
  }
  double fastest() const {
    btScalar speed = 0;
    for (const btRigidBody* ring : rings) speed = std::max(speed, ring->getLinearVelocity().length());
    return double(speed);
  }
};

TEST(Separate, PartsWhatStepsCannotWithoutSpeed) {
  Tangle tangle(8);
  const bullet::Separation done = bullet::separate(tangle.w.world);
  EXPECT_GT(done.overlaps, 4);
  EXPECT_EQ(done.left, 0) << "of " << done.overlaps << " after " << done.passes << " passes";
  EXPECT_EQ(tangle.fastest(), 0);
  EXPECT_LT(done.moved, 3);
  EXPECT_EQ(bullet::separate(tangle.w.world).overlaps, 0);
  tangle.w.step(600);
  EXPECT_LT(tangle.fastest(), 0.05);
}

TEST(Separate, GivesTheSameBitsAndLeavesWhatIsFree) {
  Tangle one(5), other(5);
  (void)bullet::separate(one.w.world);
  (void)bullet::separate(other.w.world);
  EXPECT_EQ(one.w.stateHash(), other.w.stateHash());
  const std::uint64_t before = one.w.stateHash();
  EXPECT_EQ(bullet::separate(one.w.world).moved, 0);
  EXPECT_EQ(one.w.stateHash(), before);
}

// Out of the ground, which does not move.
TEST(Separate, PushesBodiesOutOfWhatIsStatic) {
  BulletWorld<> w;
  btRigidBody& ground = w.addGround();
  const btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 4))), 1, btVector3(0, 0, btScalar(0.2)));
  EXPECT_EQ(bullet::separate(w.world).left, 0);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5, 0.02);
  EXPECT_EQ(ground.getWorldTransform().getOrigin(), btVector3(0, 0, 0));
}

}  // namespace
}  // namespace cairn::test::overlap_test
