// SPDX-License-Identifier: Zlib
// The order in which the solver meets manifolds does not tell who made them when.
#include "cairn/bullet/manifold_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bullet_world.h"

namespace cairn::test::manifold_order_test {
namespace {

constexpr int kBodies = 5, kBetweenTwo = 3;

class Manifolds {
 public:
  Manifolds() {
    for (int i = 0; i < kBodies; ++i)
      bodies_.push_back(&w_.add(std::make_shared<btSphereShape>(1), 1, btVector3(i, 0, 0)));
  }
  // Between two bodies one manifold without a point, one with one and one with another.
  void make(int what) {
    const int pair = what / kBetweenTwo, which = what % kBetweenTwo;
    btPersistentManifold* const m = w_.dispatcher.getNewManifold(bodies_[pair / kBodies], bodies_[pair % kBodies]);
    if (which == 0) return;
    m->addManifoldPoint(btManifoldPoint(btVector3(0, 0, 0), btVector3(btScalar(which), 0, 0), btVector3(0, 0, 1), 0));
  }
  std::vector<std::vector<double>> order() {
    bullet::orderManifolds(w_.dispatcher);
    std::vector<std::vector<double>> all;
    for (int i = 0; i < w_.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w_.dispatcher.getManifoldByIndexInternal(i);
      EXPECT_EQ(m.m_index1a, i) << "Bullet finds it there to release it";
      all.push_back({double(m.getBody0()->getBroadphaseHandle()->m_uniqueId),
                     double(m.getBody1()->getBroadphaseHandle()->m_uniqueId), double(m.getNumContacts()),
                     m.getNumContacts() > 0 ? double(m.getContactPoint(0).m_localPointB.x()) : 0});
    }
    return all;
  }
  void release(int i) { w_.dispatcher.releaseManifold(w_.dispatcher.getManifoldByIndexInternal(i)); }
  ~Manifolds() {
    while (w_.dispatcher.getNumManifolds() > 0) release(0);
  }

 private:
  BulletWorld<btCollisionDispatcher> w_;
  std::vector<btRigidBody*> bodies_;
};

TEST(ManifoldOrder, IsThatOfBodiesAndPointsWhoeverMadeThem) {
  std::vector<int> all;
  for (int i = 0; i < kBodies * kBodies * kBetweenTwo; ++i) all.push_back(i);
  Manifolds first;
  for (const int what : all) first.make(what);
  std::vector<std::vector<double>> expected = first.order();
  EXPECT_TRUE(std::ranges::is_sorted(expected));
  std::mt19937 random(17);
  for (int round = 0; round < 20; ++round) {
    std::ranges::shuffle(all, random);
    Manifolds other;
    for (const int what : all) other.make(what);
    EXPECT_EQ(other.order(), expected) << "seed 17, round " << round;
    other.release(int(random() % all.size()));  // another takes its place
    EXPECT_TRUE(std::ranges::is_sorted(other.order()));
  }
}

// Only NaN is unordered to C++; no comparison may say so.
TEST(ManifoldOrder, HasAPlaceForWhatIsNoNumber) {
  std::mt19937 random(18);
  const btScalar kNan = std::numeric_limits<btScalar>::quiet_NaN();
  BulletWorld<btCollisionDispatcher> w;
  btRigidBody& a = w.add(std::make_shared<btSphereShape>(1), 1, btVector3(0, 0, 0));
  btRigidBody& b = w.add(std::make_shared<btSphereShape>(1), 1, btVector3(1, 0, 0));
  for (int i = 0; i < 200; ++i) {
    const btVector3 at(random() % 2 ? kNan : btScalar(random() % 5), 0, 0);
    w.dispatcher.getNewManifold(&a, &b)->addManifoldPoint(btManifoldPoint(at, at, btVector3(0, 0, 1), kNan));
  }
  bullet::orderManifolds(w.dispatcher);
  for (int i = 1, numbers = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const auto x = [&](int k) {
      return w.dispatcher.getManifoldByIndexInternal(k)->getContactPoint(0).m_localPointB.x();
    };
    numbers += std::isnan(x(i - 1)) != std::isnan(x(i)) ? 1 : 0;
    EXPECT_LE(numbers, 1) << "numbers and none lie among each other";
  }
  while (w.dispatcher.getNumManifolds() > 0) w.dispatcher.releaseManifold(w.dispatcher.getManifoldByIndexInternal(0));
}

}  // namespace
}  // namespace cairn::test::manifold_order_test
