// SPDX-License-Identifier: Zlib
// A body that is small against the leaves below it touches them where their faces do: on corners of either and
// where their edges cross.
#include <gtest/gtest.h>

#include "bullet_world.h"

namespace cairn::test::small_on_leaf_test {
namespace {

constexpr btScalar kHalfSlab = 5;
// A body at rest lies within the distance that contacts are kept at, and Bullet's own allowance.
constexpr btScalar kRestTolerance = bullet::kSpeculativeFraction;

btRigidBody& addSlab(BulletWorld<>& w, int cells, std::uint32_t trianglesPerLeaf) {
  const double size = 2 * double(kHalfSlab);
  return w.add(treeShape(plainTree(cuboid({size, size, 1}, cells), trianglesPerLeaf)), 0,
               btVector3(0, 0, btScalar(-0.5)));
}

class SmallOnLeaf : public testing::TestWithParam<std::tuple<int, std::uint32_t>> {};

// Its centre is over the slab, two or three of its corners are not: what it stands on is where the edges cross.
TEST_P(SmallOnLeaf, ABoxOverACornerStays) {
  const auto& [cells, perLeaf] = GetParam();
  for (const btScalar inX : {btScalar(0.1), btScalar(0.2), btScalar(0.4)})
    for (const btScalar inY : {btScalar(0.1), btScalar(0.3)}) {
      BulletWorld<> w;
      addSlab(w, cells, perLeaf);
      const btVector3 start(kHalfSlab - inX, kHalfSlab - inY, btScalar(0.5));
      const btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1) / 2), 1, start);
      w.step(180);
      EXPECT_LT((box.getWorldTransform().getOrigin() - start).length(), kRestTolerance * std::sqrt(btScalar(3)))
          << inX << " " << inY;
    }
}

TEST_P(SmallOnLeaf, AThinRodLiesStill) {
  const auto& [cells, perLeaf] = GetParam();
  for (const btScalar width : {btScalar(0.05), btScalar(0.1)}) {
    BulletWorld<> w;
    addSlab(w, cells, perLeaf);
    const auto shape = std::make_shared<btBoxShape>(btVector3(btScalar(2.4), width, width) / 2);
    btRigidBody& rod = w.add(shape, 1, btVector3(btScalar(0.3), btScalar(0.2), width),
                             btQuaternion(btVector3(0, 0, 1), btScalar(0.4)));
    rod.setActivationState(DISABLE_DEACTIVATION);
    w.step(300);
    EXPECT_LT(rod.getLinearVelocity().length() + rod.getAngularVelocity().length(), 0.01) << width;
    EXPECT_NEAR(rod.getWorldTransform().getOrigin().z(), width / 2, kRestTolerance * btScalar(2.4)) << width;
  }
}

INSTANTIATE_TEST_SUITE_P(Slabs, SmallOnLeaf, testing::Combine(testing::Values(1, 2, 4), testing::Values(2U, 8U)));

// Its lowest point is beside the post: what a flat leaf and a round one have in common is on the post.
TEST(RoundBesideAnEdge, FallsOffThePost) {
  const auto post = treeShape(plainTree(cuboid({0.5, 0.5, 1}, 1)));
  for (const std::uint32_t perLeaf : {8U, 32U}) {
    BulletWorld<> w;
    w.add(post, 0, btVector3(0, 0, btScalar(-0.5)));
    btRigidBody& body = w.add(treeShape(plainTree(ball(1, 12), perLeaf)), 1, btVector3(btScalar(0.4), 0, 1));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(600);
    EXPECT_LT(body.getWorldTransform().getOrigin().z(), 0) << perLeaf << " triangles a leaf";
  }
}

}  // namespace
}  // namespace cairn::test::small_on_leaf_test
