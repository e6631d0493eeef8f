// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <atomic>
#include <compare>
#include <cstdint>

#include "cairn/bullet/sphere_tree_shape.h"
#include "platform/prefetch.h"

namespace cairn::bullet {

/// Two bodies, whatever their order. Their addresses are only compared: the bodies may be gone.
struct ServedPair {
  std::uintptr_t lower = 0, upper = 0;
  static ServedPair of(const btCollisionObject* a, const btCollisionObject* b) {
    const auto first = reinterpret_cast<std::uintptr_t>(a), second = reinterpret_cast<std::uintptr_t>(b);
    return first < second ? ServedPair{first, second} : ServedPair{second, first};
  }
  bool isKnown() const { return upper != 0; }
  auto operator<=>(const ServedPair&) const = default;
};

/// Addresses of Bullet's algorithm for a pair and of its tree's body, from Bullet's last question. They are only
/// prefetched, also by other threads, and never read: the objects may be gone.
struct PairHandles {
  std::atomic<const void*> algorithm{nullptr};
  std::atomic<const btCollisionObject*> treeObject{nullptr};
  std::atomic<const btCollisionShape*> treeShape{nullptr};
  ServedPair served;  ///< while Bullet has an algorithm for them

  void setAlgorithm(const void* made) { algorithm.store(made, std::memory_order_relaxed); }
  void note(const btCollisionObjectWrapper& tree) {
    treeObject.store(tree.getCollisionObject(), std::memory_order_relaxed);
    treeShape.store(tree.getCollisionShape(), std::memory_order_relaxed);
  }
  /// Prefetches the objects behind the addresses.
  void prefetchAlgorithm() const { prefetch(algorithm.load(std::memory_order_relaxed), 1); }
  void prefetchBody() const {
    constexpr std::size_t kBodyBytes = 512;  // up to a rigid body's velocities
    prefetch(treeObject.load(std::memory_order_relaxed), kBodyBytes);
    prefetch(treeShape.load(std::memory_order_relaxed), sizeof(SphereTreeShape));
  }
};

}  // namespace cairn::bullet
