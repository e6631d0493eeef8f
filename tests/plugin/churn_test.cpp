// SPDX-License-Identifier: Zlib
// Bodies that come, go, grow, jump and change their shapes, in random order: nothing is left behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "front_ends.h"

namespace cairn::test::churn_test {
namespace {

constexpr std::uint32_t kSeed = 5;
constexpr int kOperations = 10000;
constexpr std::size_t kMaxBodies = 24;

template <class FrontEndType>
class Churn : public testing::Test {
 protected:
  using World = BulletWorld<FrontEndType>;

  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  btVector3 place() { return {btScalar(3 * part()), btScalar(3 * part()), btScalar(0.3 + 2 * part())}; }
  btRigidBody& any() { return *bodies_[static_cast<std::size_t>(part() * double(bodies_.size()))]; }

  std::shared_ptr<btCollisionShape> anyShape() {
    static const std::shared_ptr<const SphereTree> trees[] = {plainTree(torus(0.35, 0.12, 10)),
                                                              plainTree(cuboid({0.8, 0.4, 0.3}, 2))};
    switch (static_cast<int>(5 * part())) {
      case 0:
        return std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.2)));
      case 1: {
        auto compound = std::make_shared<btCompoundShape>();
        kept_.push_back(treeShape(trees[0]));
        compound->addChildShape(btTransform::getIdentity(), kept_.back().get());
        return compound;
      }
      default:
        return treeShape(trees[part() < 0.5 ? 0 : 1], btScalar(0.5 + part()));
    }
  }

  void doOne(World& w) {
    const int what = bodies_.empty() ? 0 : static_cast<int>(7 * part());
    if (what == 0 && bodies_.size() < kMaxBodies) {
      bodies_.push_back(&w.add(anyShape(), 1, place()));
      if (part() < 0.2) bodies_.back()->setCcdMotionThreshold(btScalar(0.1));
    } else if (what == 1) {
      btRigidBody& body = any();
      std::erase(bodies_, &body);
      w.remove(body);
    } else if (what == 2) {
      btTransform t = any().getWorldTransform();
      t.setOrigin(place());
      any().setWorldTransform(t);
    } else if (what == 3) {
      btCollisionShape* const shape = any().getCollisionShape();
      const auto s = btScalar(0.5 + part());
      if (shape->getShapeType() == FAST_CONCAVE_MESH_PROXYTYPE) shape->setLocalScaling(btVector3(s, s, s));
    } else if (what == 4) {
      btRigidBody& body = any();
      const btCollisionShape* const before = body.getCollisionShape();
      kept_.push_back(anyShape());
      body.setCollisionShape(kept_.back().get());
      // As Bullet wants it of compounds and of its own shapes: what it remembers of the old one would outlive it.
      const bool isOurs = bullet::asSphereTree(before) && bullet::asSphereTree(body.getCollisionShape());
      if (isOurs) return;
      w.world.getBroadphase()->getOverlappingPairCache()->cleanProxyFromPairs(body.getBroadphaseHandle(),
                                                                              &w.dispatcher);
    } else if (what == 5) {
      any().setLinearVelocity(
          btVector3(btScalar(8 * part() - 4), btScalar(8 * part() - 4), btScalar(20 * part() - 10)));
    } else {
      bullet::StepBudget budget;
      if (part() < 0.7) budget.operations = static_cast<std::int64_t>(5000 * part());
      EXPECT_TRUE(w.dispatcher.setBudget(budget));
    }
  }

  // Whether every manifold is of two bodies that live.
  static bool allLive(World& w) {
    const btCollisionObjectArray& objects = w.world.getCollisionObjectArray();
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      for (const btCollisionObject* body : {m.getBody0(), m.getBody1()})
        if (objects.findLinearSearch(const_cast<btCollisionObject*>(body)) == objects.size()) return false;
    }
    return true;
  }

  std::mt19937 random_{kSeed};
  std::vector<btRigidBody*> bodies_;
  std::vector<std::shared_ptr<btCollisionShape>> kept_;  // outlive the world's bodies
};
TYPED_TEST_SUITE(Churn, EveryFrontEnd, FrontEndName);

TYPED_TEST(Churn, LeavesNothingBehind) {
  BulletWorld<TypeParam> w;
  w.addGround();
  for (int i = 0; i < kOperations; ++i) {
    this->doOne(w);
    if (i % 3 == 0) w.step();
    ASSERT_TRUE(this->allLive(w)) << "seed " << kSeed << ", operation " << i;
    for (const btRigidBody* body : this->bodies_) ASSERT_TRUE(isSane(*body)) << "seed " << kSeed << ", operation " << i;
  }
  while (!this->bodies_.empty()) {
    w.remove(*this->bodies_.back());
    this->bodies_.pop_back();
  }
  EXPECT_EQ(w.dispatcher.getNumManifolds(), 0);
}

}  // namespace
}  // namespace cairn::test::churn_test
