// SPDX-License-Identifier: Zlib
// Where a flat face is cut into leaves, nothing that sinks into it is pushed aside by their borders.
#include "colliders/inner_edges.h"

#include <gtest/gtest.h>

#include <random>

#include "bullet_world.h"
#include "test_trees.h"

namespace cairn::test::inner_edges_test {
namespace {

struct Slab {
  const char* name;
  std::uint32_t cells;
};

class InnerEdges : public testing::TestWithParam<Slab> {
 protected:
  std::shared_ptr<btCollisionShape> slab() const { return treeShape(plainTree(cuboid({16, 16, 1}, GetParam().cells))); }
};
INSTANTIATE_TEST_SUITE_P(Slabs, InnerEdges, testing::Values(Slab{"Coarse", 4}, Slab{"Fine", 16}, Slab{"Finer", 24}),
                         [](const auto& slab) { return std::string(slab.param.name); });

// The greatest sideways speed of a ball that has sunk in by up to 5 cm and is let go, without friction, m/s.
TEST_P(InnerEdges, DoNotPushABallAside) {
  constexpr int kSeed = 5, kPlaces = 100;
  std::mt19937 random(kSeed);
  const auto between = [&](double from, double to) {
    return btScalar(std::uniform_real_distribution<double>(from, to)(random));
  };
  int aside = 0, touching = 0;
  for (int i = 0; i < kPlaces; ++i) {
    BulletWorld<> w;
    w.add(slab(), 0, btVector3(0, 0, btScalar(-0.5))).setFriction(0);
    const btVector3 place(between(-3, 3), between(-3, 3), btScalar(0.3) - between(0.001, 0.05));
    const btRigidBody& ball = w.add(std::make_shared<btSphereShape>(btScalar(0.3)), 1, place);
    for (int k = 0; k < 10; ++k) w.step();
    const btVector3& speed = ball.getLinearVelocity();
    touching += w.dispatcher.getNumManifolds() > 0;
    aside += std::hypot(speed.x(), speed.y()) > btScalar(0.02);
  }
  EXPECT_EQ(touching, kPlaces);
  EXPECT_EQ(aside, 0) << "of " << kPlaces << " places, seed " << kSeed;
}

// A ball beside the slab's rim, its middle outside, is held by the rim, which is an edge of the body.
TEST_P(InnerEdges, AnEdgeOfTheBodyStaysOne) {
  for (const double depth : {0.005, 0.02}) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(slab(), 0, btVector3(0, 0, btScalar(-0.5)));
    const double reach = (0.3 - depth) / std::sqrt(2.0);
    const btRigidBody& ball = w.add(std::make_shared<btSphereShape>(btScalar(0.3)), 1,
                                    btVector3(btScalar(8 + reach), btScalar(0.37), btScalar(reach)));
    w.world.performDiscreteCollisionDetection();
    double deepest = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
      const btScalar towards = m.getBody0() == &ball ? btScalar(1) : btScalar(-1);
      for (int k = 0; k < m.getNumContacts(); ++k) {
        const btVector3 normal = m.getContactPoint(k).m_normalWorldOnB * towards;
        deepest = std::min(deepest, double(m.getContactPoint(k).getDistance()));
        EXPECT_GT(normal.x(), 0.5) << "away from the slab, and";
        EXPECT_GT(normal.z(), 0.5) << "up";
      }
    }
    EXPECT_NEAR(deepest, -depth, 1e-3);
  }
}

}  // namespace
}  // namespace cairn::test::inner_edges_test
