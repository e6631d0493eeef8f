// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "bullet_world.h"

namespace cairn::test {

/// Two dozen balls and blocks that fall into a heap between four walls, on a budget of operations a step.
struct WalledHeap {
  BulletWorld<> w;
  std::vector<btRigidBody*> bodies;
  btScalar peakSpeed = 0;

  static std::shared_ptr<const SphereTree> round() { return plainTree(ball(0.3, 6)); }
  static std::shared_ptr<const SphereTree> square() { return plainTree(cuboid({0.5, 0.4, 0.3}, 3)); }

  explicit WalledHeap(std::optional<std::int64_t> operations, bullet::Unresolved policy = bullet::Unresolved::guard) {
    if (!w.dispatcher.setBudget({operations, {}})) throw std::runtime_error("the budget was refused");
    w.dispatcher.setUnresolved(policy);
    w.addGround();
    // Walls, so that a heap stays a heap.
    for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
      w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-1)), 0, btVector3(0, 0, 0));
    const auto roundTree = round(), squareTree = square();
    for (int i = 0; i < 24; ++i) {
      const btVector3 place(btScalar(i % 2) - btScalar(0.5), btScalar(i / 2 % 2) - btScalar(0.45),
                            btScalar(0.4) + btScalar(0.7) * btScalar(i / 4));
      bodies.push_back(&w.add(treeShape(i % 3 ? roundTree : squareTree), 1, place));
    }
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      w.step();
      for (const btRigidBody* body : bodies) peakSpeed = std::max(peakSpeed, body->getLinearVelocity().length());
    }
  }
};

/// How the heap ends on every compiler, at every level of optimisation and on every instruction set. When what contacts
/// are made of changes on purpose, put in what the failing test prints.
inline constexpr std::uint64_t kGoldenHash =
    sizeof(btScalar) == sizeof(float) ? 0x94bab13e29182a61 : 0x9a49316452c42e5c;

inline std::uint64_t goldenHash() {
  WalledHeap heap(20000);
  heap.run(240);
  return heap.w.stateHash();
}

}  // namespace cairn::test
