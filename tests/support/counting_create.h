// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btEmptyCollisionAlgorithm.h>

namespace cairn::test {

/// An entry that a user may have in a dispatcher's tables: makes algorithms that do nothing, and counts them.
struct CountingCreate final : btCollisionAlgorithmCreateFunc {
  int calls = 0;
  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper*,
                                                 const btCollisionObjectWrapper*) override {
    ++calls;
    return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(btEmptyAlgorithm))) btEmptyAlgorithm(info);
  }
};

}  // namespace cairn::test
