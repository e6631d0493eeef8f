// SPDX-License-Identifier: Zlib
// Bodies of few triangles, corner first.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bullet_world.h"
#include "random_tree.h"
#include "test_solids.h"
#include "test_trees.h"

namespace cairn::test::few_triangles_test {
namespace {

constexpr unsigned kSeed = 7;
// Bodies of a metre or two in floats: products and sums of a few lengths, each rounded to 2^-24 of them.
constexpr float kRounding = 64 * 0x1p-24F;

Solid randomCuboid(std::mt19937_64& engine) {
  return cuboid({uniform(engine, 0.3, 1), uniform(engine, 0.3, 1), uniform(engine, 0.3, 1)}, 1);
}

TEST(FewTriangles, TouchAPlaneWithTheirLowestVertices) {
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 100; ++i) {
    BulletWorld<> w;
    w.addGround();
    btMatrix3x3 turn;
    const Mat3d r = randomRotation(engine);
    for (int k = 0; k < 3; ++k) turn[k].setValue(btScalar(r.rows[k].x), btScalar(r.rows[k].y), btScalar(r.rows[k].z));
    btQuaternion rotation;
    turn.getRotation(rotation);
    const auto shape = treeShape(plainTree(randomCuboid(engine)));
    btRigidBody& body = w.add(shape, 1, btVector3(0, 0, 0), rotation);
    btVector3 lowest(0, 0, 100);
    for (const Vec3& v : shape->tree().vertices()) {
      const btVector3 placed = body.getWorldTransform() * shape->bodyFromTree() * btVector3(v.x, v.y, v.z);
      if (placed.z() < lowest.z()) lowest = placed;
    }
    btTransform pose = body.getWorldTransform();
    pose.getOrigin().setZ(btScalar(0.001) - lowest.z());
    body.setWorldTransform(pose);
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(0);
    ASSERT_GE(m.getNumContacts(), 1);
    btScalar least = 1;
    for (int k = 0; k < m.getNumContacts(); ++k) least = std::min(least, m.getContactPoint(k).getDistance());
    EXPECT_NEAR(least, 0.001, kRounding) << "seed " << kSeed << ", case " << i;
  }
}

// Less than a thousandth apart, a corner beside a corner: what leaves say of that had been 0.13 deep.
TEST(FewTriangles, WhatIsJustApartIsNotDeep) {
  BulletWorld<> w;
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 1))), 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(cuboid({0.1, 0.1, 2}, 1))), 1,
        btVector3(btScalar(-0.153226241), btScalar(1.29538965), btScalar(0.473397017)),
        btQuaternion(btScalar(-0.573605716), btScalar(0.43209523), btScalar(0.105297394), btScalar(0.687882781)));
  w.world.performDiscreteCollisionDetection();
  for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(m);
    for (int i = 0; i < manifold.getNumContacts(); ++i)
      EXPECT_GT(manifold.getContactPoint(i).getDistance(), btScalar(-0.001));
  }
}

}  // namespace
}  // namespace cairn::test::few_triangles_test
