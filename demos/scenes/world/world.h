// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/core/result.h"
#include "cairn/core/state_hash.h"
#include "scenes/bodies/body_shape.h"
#include "scenes/world/contact_loads.h"
#include "scenes/world/priority_choice.h"

namespace cairn::scenes {

/// One simulation step as it was measured.
struct StepRecord {
  double narrowPhaseCpuUs = 0;  ///< thread CPU time of the dispatch
  double stepCpuUs = 0;         ///< thread CPU time of the whole step
  std::uint32_t contacts = 0;   ///< points of all manifolds
  std::uint32_t manifolds = 0;  ///< all manifolds the dispatcher holds, empty ones included: the solver looks at each
  /// What the sphere-tree narrow phase says of itself; nothing for other shapes.
  std::optional<bullet::StepStatistics> tree;
};

struct WorldOptions {
  ShapeKind shape = ShapeKind::tree;
  bullet::StepBudget budget;
  bullet::Unresolved unresolved = bullet::Unresolved::guard;
  PriorityKind priority = PriorityKind::roundRobin;
  std::optional<Viewer> viewer;  ///< whose seen error is measured, and whom priorities that care serve
  bool sleeping = true;
  double timeStep = 1.0 / 60;  ///< seconds
  double gravity = 9.81;       ///< m/s^2 along -z
};

/// Where a body is and how it moves, world frame.
struct BodyMotion {
  btTransform pose;
  btVector3 linearVelocity;   ///< of its centre of mass, m/s
  btVector3 angularVelocity;  ///< rad/s
};

/// A point of a manifold: two bodies by their numbers, and the point each of them is said to have there, world frame.
struct ReportedContact {
  int first = 0, second = 0;
  Vec3d onFirst, onSecond;
};

/// A plain Bullet world whose narrow phase is timed, default solver, and the bodies in it. Only its dispatcher depends
/// on the shape its moving bodies have.
class World {
 public:
  /// Fails for a budget or a viewer the dispatcher refuses.
  static Result<std::unique_ptr<World>> create(const WorldOptions& options);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Adds a body; `mass` 0 makes it static. `shape` must outlive the world. Bullet's user index is the body's number:
  /// its place in `bodies()`, or `staticNumber(i)` for the i-th static one.
  btRigidBody& addBody(btCollisionShape& shape, const btTransform& pose, btScalar mass, const btVector3& inertia);

  StepRecord step();

  double timeStep() const { return options_.timeStep; }

  /// Of every step from now on. Shapes other than the tree have none. Fails for one the dispatcher refuses.
  Status setBudget(const bullet::StepBudget& budget);

  /// Puts every moving body where `motions` says, in the bodies' order, and looks for collisions alone: nothing
  /// responds, nothing moves on. Precondition: one motion a body.
  StepRecord show(std::span<const BodyMotion> motions);

  /// Every point of every manifold, as of the last step.
  std::vector<ReportedContact> contacts() const;

  /// The moving bodies as they are now.
  std::vector<BodyMotion> motions() const;
  std::vector<btTransform> poses() const;

  /// Moving bodies, in the order they were added.
  std::span<btRigidBody* const> bodies() const { return moving_; }
  static constexpr int staticNumber(std::size_t i) { return -1 - static_cast<int>(i); }

  /// As of the last step, by the bodies' numbers.
  const ContactLoads& loads() const { return loads_; }

  /// Feeds every moving body's pose and velocities to `hash`.
  void addState(StateHash& hash) const;

 private:
  using TreeDispatcher = bullet::Dispatcher<btCollisionDispatcher>;

  explicit World(const WorldOptions& options);
  void makeDispatcher();
  StepRecord record(double stepCpuUs) const;

  WorldOptions options_;
  double narrowPhaseCpuUs_ = 0;
  btDefaultCollisionConfiguration configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  TreeDispatcher* treeDispatcher_ = nullptr;  // the same object when the shape is a tree
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<btRigidBody*> moving_;
  ContactLoads loads_;
};

/// Greatest speed among bodies, m/s.
double fastestSpeed(std::span<btRigidBody* const> bodies);
/// Of translation and rotation, J. Precondition: a body that moves and turns.
double kineticEnergy(const btRigidBody& body);
/// Kinetic energy per unit of mass, mean over bodies, J/kg.
double meanKineticEnergy(std::span<btRigidBody* const> bodies);
std::uint32_t countAsleep(std::span<btRigidBody* const> bodies);

}  // namespace cairn::scenes
