// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>

#include <memory>

#include "cairn/bullet/narrow_phase.h"
#include "pairs/collider_kinds.h"
#include "pairs/pair_handles.h"

namespace cairn::bullet {

struct TreePair;

/// The pair that an algorithm serves. `mayDefer`: it may answer later than it is asked; queries cannot wait.
struct TreeAlgorithmFor {
  ColliderKind kind;
  ServedPair bodies;
  bool mayDefer;
};

/// Bullet's algorithm for a pair with a sphere-tree. It holds the pair's state and a share of the narrow phase, which
/// may leave the dispatcher while Bullet still holds this. It must stay small, because Bullet's pool of algorithms
/// hands out elements of one size.
class TreeAlgorithm final : public btCollisionAlgorithm {
 public:
  TreeAlgorithm(const btCollisionAlgorithmConstructionInfo& info, std::shared_ptr<NarrowPhase::Impl> narrowPhase,
                const TreeAlgorithmFor& pair);
  ~TreeAlgorithm() override;
  TreeAlgorithm(const TreeAlgorithm&) = delete;
  TreeAlgorithm& operator=(const TreeAlgorithm&) = delete;

  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  /// Returns 1: no time of impact is computed. Fast trees get speculative contacts instead, see `continuous/sweep.h`.
  btScalar calculateTimeOfImpact(btCollisionObject* body0, btCollisionObject* body1, const btDispatcherInfo& info,
                                 btManifoldResult* result) override;
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  std::shared_ptr<NarrowPhase::Impl> narrowPhase_;
  TreePair* pair_;
  bool mayDefer_;
};
static_assert(sizeof(TreeAlgorithm) <= sizeof(btConvexConvexAlgorithm));

}  // namespace cairn::bullet
