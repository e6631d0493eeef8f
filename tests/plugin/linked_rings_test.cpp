// SPDX-License-Identifier: Zlib
// Bodies that hang in each other: they would come free by parting, which no sphere around them forbids.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <random>
#include <vector>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::linked_rings_test {
namespace {

constexpr double kRing = 0.38, kTube = 0.115;  // metres, as the rings of a chain of one metre a link
constexpr int kLinks = 5, kChains = 12;
constexpr int kCorners = 24;

btVector3 cornerOf(const btTransform& pose, int k) {
  const double angle = 2 * std::numbers::pi * k / kCorners;
  return pose * btVector3(btScalar(kRing * std::cos(angle)), btScalar(kRing * std::sin(angle)), 0);
}

// The solid angle over 4 pi that two edges see of each other (Klenin and Langowski 2000, method 1a).
double linkOf(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& d) {
  const btVector3 ac = c - a, ad = d - a, bc = c - b, bd = d - b;
  std::array<btVector3, 4> n{ac.cross(ad), ad.cross(bd), bd.cross(bc), bc.cross(ac)};
  for (btVector3& normal : n) normal.safeNormalize();
  double angle = 0;
  for (std::size_t k = 0; k < 4; ++k) angle += std::asin(std::clamp(double(n[k].dot(n[(k + 1) % 4])), -1.0, 1.0));
  return (d - c).cross(b - a).dot(ac) > 0 ? angle / (4 * std::numbers::pi) : -angle / (4 * std::numbers::pi);
}

// Gauss's linking number of the rings' centre lines.
bool areLinked(const btRigidBody& x, const btRigidBody& y) {
  const btTransform &poseX = x.getWorldTransform(), &poseY = y.getWorldTransform();
  double sum = 0;
  for (int i = 0; i < kCorners; ++i)
    for (int k = 0; k < kCorners; ++k)
      sum += linkOf(cornerOf(poseX, i), cornerOf(poseX, i + 1), cornerOf(poseY, k), cornerOf(poseY, k + 1));
  return std::abs(std::lround(sum)) == 1;
}

// Chains that fall in a heap between walls.
struct Chains {
  BulletWorld<> w;
  std::vector<btRigidBody*> rings;

  explicit Chains(std::uint64_t seed) {
    static const auto tree = plainTree(torus(kRing, kTube, 28));
    std::mt19937_64 engine(seed);
    w.addGround();
    for (const double side : {-1.0, 1.0})
      for (const bool isX : {true, false}) {
        const btVector3 inward(btScalar(isX ? -side : 0), btScalar(isX ? 0 : -side), 0);
        w.add(std::make_shared<btStaticPlaneShape>(inward, btScalar(-1.6)), 0, btVector3(0, 0, 0));
      }
    for (int chain = 0; chain < kChains; ++chain) {
      const double x = chain % 3 - 1, y = chain / 3 % 3 - 1, low = 1 + 3 * (chain / 9);
      const btQuaternion heading(btVector3(0, 0, 1), btScalar(uniform(engine, 0, 2 * std::numbers::pi)));
      for (int k = 0; k < kLinks; ++k) {
        const btQuaternion upright(btVector3(1, 0, 0), btScalar(std::numbers::pi / 2));
        const btQuaternion across(btVector3(0, 0, 1), btScalar(k % 2 * std::numbers::pi / 2));
        const btVector3 at(btScalar(1.05 * x + uniform(engine, -0.005, 0.005)), btScalar(1.05 * y),
                           btScalar(low + 1.3 * kRing * k));
        rings.push_back(&w.add(treeShape(tree), 1, at, heading * across * upright));
      }
    }
  }
  int countParted() const {
    int parted = 0;
    for (std::size_t i = 1; i < rings.size(); ++i)
      if (i % kLinks != 0 && !areLinked(*rings[i - 1], *rings[i])) ++parted;
    return parted;
  }
};

TEST(LinkedRings, AreLinkedWhereTheyBegin) {
  const Chains chains(1);
  EXPECT_EQ(chains.countParted(), 0);
  EXPECT_FALSE(areLinked(*chains.rings[0], *chains.rings[2]));
}

// A step in full takes some 350,000 operations. Where guards act one way only, one link in twelve parts; where both,
// one in two hundred or fewer.
TEST(LinkedRings, StayLinkedOnASmallBudget) {
  constexpr double kMayPart = 0.02;
  int links = 0, parted = 0;
  for (const std::int64_t operations : {6000, 12000, 25000, 50000})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Chains chains(seed);
      ASSERT_TRUE(chains.w.dispatcher.setBudget({operations, {}}).ok());
      chains.w.step(180);
      if (const int now = chains.countParted(); now > 0) {
        parted += now;
        std::cout << now << " parted: seed " << seed << ", " << operations << " operations\n";
      }
      links += kChains * (kLinks - 1);
    }
  EXPECT_LE(parted, kMayPart * links);
}

// A locked pair is free again when it is answered: balls that bounce fly apart.
TEST(LockedPairs, PartWhenTheyAreAnswered) {
  const auto tree = plainTree(ball(0.3, 12));
  for (const std::int64_t operations : {40, 100, 300, 1000}) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    std::array<btRigidBody*, 2> balls{};
    for (std::size_t i = 0; i < 2; ++i) {
      const btScalar side = i == 0 ? -1 : 1;
      balls[i] = &w.add(treeShape(tree), 1, btVector3(side * btScalar(0.5), side * btScalar(0.05), 0));
      balls[i]->setLinearVelocity(btVector3(-side * 2, 0, 0));
      balls[i]->setRestitution(1);
    }
    w.step(120);
    const btVector3 apart = balls[1]->getWorldTransform().getOrigin() - balls[0]->getWorldTransform().getOrigin();
    EXPECT_GT(double(apart.length()), 0.7) << operations << " operations";
    EXPECT_GT(double((balls[1]->getLinearVelocity() - balls[0]->getLinearVelocity()).dot(apart)), 0) << operations;
  }
}

}  // namespace
}  // namespace cairn::test::linked_rings_test
