// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCompoundCollisionAlgorithm.h>

struct btCollisionAlgorithmCreateFunc;
class btCollisionShape;
struct btCollisionObjectWrapper;

namespace cairn::bullet {

/// Whether the shape is a sphere-tree, or a compound with one in it at any depth.
bool hasTree(const btCollisionShape& shape);

/// The creators of algorithms for a compound against one of GImpact's shapes.
struct CompoundAnswers {
  btCollisionAlgorithmCreateFunc* withTree;
  btCollisionAlgorithmCreateFunc* withoutTree;
};

/// Bullet's algorithm for a compound against one of GImpact's shapes. It forwards to one of two algorithms and changes
/// between them when the compound gets its first sphere-tree or loses its last. It may outlive its creator, and it is
/// small for the same reason as `TreeAlgorithm`.
class CompoundAlgorithm final : public btCollisionAlgorithm {
 public:
  CompoundAlgorithm(const btCollisionAlgorithmConstructionInfo& info, const CompoundAnswers& answers);
  ~CompoundAlgorithm() override;
  CompoundAlgorithm(const CompoundAlgorithm&) = delete;
  CompoundAlgorithm& operator=(const CompoundAlgorithm&) = delete;

  void processCollision(const btCollisionObjectWrapper* body0, const btCollisionObjectWrapper* body1,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject* body0, btCollisionObject* body1, const btDispatcherInfo& info,
                                 btManifoldResult* result) override;
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  void forget();

  btPersistentManifold* sharedManifold_;
  CompoundAnswers answers_;
  btCollisionAlgorithm* answering_ = nullptr;
  bool isWithTree_ = false;
};
static_assert(sizeof(CompoundAlgorithm) <= sizeof(btCompoundCollisionAlgorithm));

}  // namespace cairn::bullet
