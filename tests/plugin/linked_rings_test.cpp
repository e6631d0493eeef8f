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
#include "cairn/bullet/contact_points.h"
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
// one in sixty.
TEST(LinkedRings, StayLinkedOnASmallBudget) {
  constexpr double kMayPart = 0.04;
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

// Points that let nothing slide have more friction than any material here.
bool holdsFast(const btManifoldPoint& point) {
  return point.m_combinedFriction > 1;
}

// How fast two bodies may move against each other at most, m/s.
btScalar greatestSpeed(const btCollisionObject& x, const btCollisionObject& y) {
  const auto& a = static_cast<const btRigidBody&>(x);
  const auto& b = static_cast<const btRigidBody&>(y);
  const auto reach = btScalar(kRing + kTube);
  const btScalar apart = (a.getWorldTransform().getOrigin() - b.getWorldTransform().getOrigin()).length();
  return (a.getLinearVelocity() - b.getLinearVelocity()).length() + a.getAngularVelocity().length() * reach +
         b.getAngularVelocity().length() * (reach + apart);
}

// Bodies that move by less than 0.8 % of their size a step are free.
TEST(LockedPairs, AreFast) {
  constexpr btScalar kSlow = btScalar(0.008 * 60 * 2 * (kRing + kTube));
  Chains chains(1);
  ASSERT_TRUE(chains.w.dispatcher.setBudget({12000, {}}).ok());
  int locked = 0;
  for (int step = 0; step < 240; ++step) {
    std::vector<std::vector<btScalar>> speeds(chains.rings.size(), std::vector<btScalar>(chains.rings.size()));
    for (std::size_t i = 0; i < chains.rings.size(); ++i) {
      chains.rings[i]->setUserIndex(static_cast<int>(i));
      for (std::size_t k = 0; k < chains.rings.size(); ++k)
        speeds[i][k] = greatestSpeed(*chains.rings[i], *chains.rings[k]);
    }
    chains.w.world.performDiscreteCollisionDetection();
    for (int m = 0; m < chains.w.dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *chains.w.dispatcher.getManifoldByIndexInternal(m);
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        if (!holdsFast(manifold.getContactPoint(i))) continue;
        ++locked;
        ASSERT_TRUE(bullet::isGuard(manifold.getContactPoint(i))) << "step " << step;
        const auto x = static_cast<std::size_t>(manifold.getBody0()->getUserIndex());
        const auto y = static_cast<std::size_t>(manifold.getBody1()->getUserIndex());
        ASSERT_GT(speeds[x][y], kSlow) << "step " << step;
      }
    }
    chains.w.step();
  }
  EXPECT_GT(locked, 0);
}

int countHeldFast(const btDispatcher& dispatcher) {
  int count = 0;
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(m);
    for (int i = 0; i < manifold.getNumContacts(); ++i) count += holdsFast(manifold.getContactPoint(i));
  }
  return count;
}

// Bodies that slide or roll down a slope of trees of their size. Where all fast bodies were locked, they stuck.
TEST(LockedPairs, AreNotThoseThatSlide) {
  constexpr int kSlides = 8, kTiles = 12;
  const auto tile = plainTree(cuboid({1.4, 1.4, 0.4}, 3)), body = plainTree(bowl(0.4, 0.3, 24));
  BulletWorld<> w;
  w.world.setGravity(btVector3(7, 0, -7));
  ASSERT_TRUE(w.dispatcher.setBudget({200 * kSlides, {}}).ok());
  for (int i = 0; i < kTiles * kSlides; ++i)
    w.add(treeShape(tile), 0, btVector3(btScalar(1.4 * (i / kSlides)), btScalar(1.4 * (i % kSlides)), btScalar(-0.2)));
  std::vector<btRigidBody*> bodies;
  for (int k = 0; k < kSlides; ++k)
    bodies.push_back(&w.add(treeShape(body), 1, btVector3(0, btScalar(1.4 * k), btScalar(0.42)),
                            btQuaternion(btVector3(0, 1, 0), btScalar(0.3 * k))));
  int held = 0;
  for (int step = 0; step < 100; ++step) {
    w.step();
    held += countHeldFast(w.dispatcher);
  }
  EXPECT_EQ(held, 0);
  EXPECT_GT(double(bodies[0]->getWorldTransform().getOrigin().x()), 1) << "nothing slid";
}

// A locked pair is free again when it is answered: bodies that bounce fly apart.
TEST(LockedPairs, PartWhenTheyAreAnswered) {
  const auto tree = plainTree(bowl(0.3, 0.2, 24));
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
