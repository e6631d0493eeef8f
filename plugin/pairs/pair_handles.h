// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <atomic>

#include "cairn/bullet/sphere_tree_shape.h"
#include "memory/fetch_ahead.h"

namespace cairn::bullet {

/// Bullet's handle on a pair and its tree's body, when Bullet last asked. Only fetched, also by other threads, and
/// never followed: they may be gone.
struct PairHandles {
  std::atomic<const void*> algorithm{nullptr};
  std::atomic<const btCollisionObject*> treeObject{nullptr};
  std::atomic<const btCollisionShape*> treeShape{nullptr};

  void setAlgorithm(const void* made) { algorithm.store(made, std::memory_order_relaxed); }
  void note(const btCollisionObjectWrapper& tree) {
    treeObject.store(tree.getCollisionObject(), std::memory_order_relaxed);
    treeShape.store(tree.getCollisionShape(), std::memory_order_relaxed);
  }
  /// See `fetchAhead`.
  void fetchAlgorithm() const { fetchAhead(algorithm.load(std::memory_order_relaxed), 1); }
  void fetchBody() const {
    constexpr std::size_t kBodyBytes = 512;  // up to a rigid body's velocities
    fetchAhead(treeObject.load(std::memory_order_relaxed), kBodyBytes);
    fetchAhead(treeShape.load(std::memory_order_relaxed), sizeof(SphereTreeShape));
  }
};

}  // namespace cairn::bullet
