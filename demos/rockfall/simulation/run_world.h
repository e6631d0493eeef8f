// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "rockfall/simulation/release.h"
#include "rockfall/simulation/run_effects.h"

namespace cairn::rockfall {

/// The Bullet world of one run: the ground, and the rocks from their release on. A body's user index is its rock's
/// number, -1 for the ground.
class RunWorld {
 public:
  /// Fails for a budget that the dispatcher refuses. `scene` must outlive the world.
  static Result<std::unique_ptr<RunWorld>> create(const Scene& scene, std::uint64_t run);
  ~RunWorld();
  RunWorld(const RunWorld&) = delete;
  RunWorld& operator=(const RunWorld&) = delete;

  /// Reserves memory for the pairs of this number of rocks, so that no step has to allocate it.
  void expectRocks(std::size_t rocks);
  /// Fails as the shape does.
  Result<btRigidBody*> addRock(const ReleasedRock& rock, int number);
  /// A rock that broke in the last step, and the bodies of its pieces. They replace it in the world and have no number
  /// yet.
  struct Broken {
    int number;
    std::vector<btRigidBody*> pieces;
  };
  /// Fails as the shapes do.
  Result<std::vector<Broken>> breakRocks();
  /// Removes a rock from the world; its body stays readable.
  void retire(btRigidBody& rock);
  void step();

  const btCollisionDispatcher& dispatcher() const { return dispatcher_; }
  const bullet::StepStatistics& lastStep() const { return dispatcher_.lastStep(); }
  const RunEffects& effects() const { return *effects_; }

 private:
  explicit RunWorld(const Scene& scene);
  Status prepare(std::uint64_t run);
  void addGround();
  btRigidBody& addBody(btCollisionShape& shape, btScalar mass, const btVector3& inertia, const btTransform& pose,
                       bool meetsRocks);
  /// Adds a piece. Returns its body, and its number among the effects' bodies.
  std::pair<btRigidBody*, std::uint32_t> addPiece(effects::FragmentBody piece, MaterialId material,
                                                  std::uint32_t generation, bool meetsRocks);

  const Scene& scene_;
  btDefaultCollisionConfiguration configuration_;
  bullet::Dispatcher<> dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::unique_ptr<RunEffects> effects_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace cairn::rockfall
