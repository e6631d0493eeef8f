// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bullet_world.h"
#include "test_solids.h"

namespace cairn::test {

// Bodies piled up between walls, so that every step has pairs to refine, new ones and known ones.
template <class FrontEnd>
struct Pile {
  BulletWorld<FrontEnd> w;
  std::vector<btRigidBody*> bodies;

  explicit Pile(std::optional<std::int64_t> operations, int count = 16, std::uint32_t trianglesPerLeaf = 2) {
    EXPECT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
    w.addGround();
    for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
      w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-0.7)), 0, btVector3(0, 0, 0));
    const auto round = plainTree(ball(0.3, 6), trianglesPerLeaf);
    const auto square = plainTree(cuboid({0.5, 0.4, 0.3}, 3), trianglesPerLeaf);
    for (int i = 0; i < count; ++i) add(i % 3 ? round : square, i);
  }
  void add(const std::shared_ptr<const SphereTree>& tree, int i) {
    const btVector3 place(btScalar(0.6) * btScalar(i % 2) - btScalar(0.3),
                          btScalar(0.6) * btScalar(i / 2 % 2) - btScalar(0.3),
                          btScalar(0.4) + btScalar(0.6) * btScalar(i / 4));
    bodies.push_back(&w.add(treeShape(tree), 1, place));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
  }
  // Of the next steps. What lies still is carried over for some of them.
  std::uint64_t mostOperations(int steps) {
    std::uint64_t most = 0;
    for (int i = 0; i < steps; ++i) {
      w.step();
      most = std::max(most, w.dispatcher.lastStep().operations);
    }
    return most;
  }
  void expectNobodyLost() const {
    for (const btRigidBody* body : bodies) {
      ASSERT_TRUE(isSane(*body));
      const btVector3& p = body->getWorldTransform().getOrigin();
      EXPECT_GT(p.z(), 0.05);
      EXPECT_LT(std::max(std::abs(p.x()), std::abs(p.y())), 0.65);
    }
  }
};

}  // namespace cairn::test
