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

/// The measurements of one simulation step.
struct StepRecord {
  double narrowPhaseCpuUs = 0;  ///< thread CPU time of the dispatch
  double stepCpuUs = 0;         ///< thread CPU time of the whole step
  std::uint32_t contacts = 0;   ///< points of all manifolds
  std::uint32_t manifolds =
      0;  ///< all manifolds of the dispatcher, empty ones included, because the solver visits each
  /// Statistics of the sphere-tree narrow phase; nothing for other shapes.
  std::optional<bullet::StepStatistics> tree;
};

struct WorldOptions {
  ShapeKind shape = ShapeKind::tree;
  bullet::StepBudget budget;
  bullet::Unresolved unresolved = bullet::Unresolved::guard;
  PriorityKind priority = PriorityKind::roundRobin;
  std::optional<Viewer> viewer;  ///< for the seen error, and for priorities that depend on a viewer
  bool sleeping = true;
  double timeStep = 1.0 / 60;  ///< seconds
  double gravity = 9.81;       ///< m/s^2 along -z
};

/// Pose and velocities of a body, world frame.
struct BodyMotion {
  btTransform pose;
  btVector3 linearVelocity;   ///< of the centre of mass, m/s
  btVector3 angularVelocity;  ///< rad/s
};

/// A point of a manifold: two bodies by number, and the contact's point on each of them, world frame.
struct ReportedContact {
  int first = 0, second = 0;
  Vec3d onFirst, onSecond;
};

/// A plain Bullet world with default solver and a timed narrow phase, and its bodies. Only the dispatcher depends on
/// the shape of the moving bodies.
///
///     auto world = World::create({.shape = ShapeKind::tree}).value();
///     world->addBody(shape, pose, 1, model.inertia);
///     StepRecord record = world->step();
class World {
 public:
  /// Fails for a budget or a viewer that the dispatcher refuses.
  static Result<std::unique_ptr<World>> create(const WorldOptions& options);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Adds a body; `mass` 0 makes it static. `shape` must outlive the world. Bullet's user index is the body's number:
  /// its index in `bodies()`, or `staticNumber(i)` for the i-th static body.
  btRigidBody& addBody(btCollisionShape& shape, const btTransform& pose, btScalar mass, const btVector3& inertia);

  StepRecord step();

  double timeStep() const { return options_.timeStep; }

  /// Sets the budget of every step from now on. It has no effect for shapes other than the tree. Fails for a budget
  /// that the dispatcher refuses.
  Status setBudget(const bullet::StepBudget& budget);

  /// Moves every moving body to its pose in `motions`, in the bodies' order, and runs collision detection alone: no
  /// response and no motion. Precondition: there is one motion for each body.
  StepRecord show(std::span<const BodyMotion> motions);

  /// Returns every point of every manifold of the last step.
  std::vector<ReportedContact> contacts() const;

  /// Returns the current motions of the moving bodies.
  std::vector<BodyMotion> motions() const;
  std::vector<btTransform> poses() const;

  /// Moving bodies, in the order they were added.
  std::span<btRigidBody* const> bodies() const { return moving_; }
  static constexpr int staticNumber(std::size_t i) { return -1 - static_cast<int>(i); }

  /// The loads of the last step, by the bodies' numbers.
  const ContactLoads& loads() const { return loads_; }

  /// Adds every moving body's pose and velocities to `hash`.
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

/// Returns the greatest speed of the bodies, m/s.
double fastestSpeed(std::span<btRigidBody* const> bodies);
/// Returns the energy of translation and rotation, J. Precondition: the body can move and turn.
double kineticEnergy(const btRigidBody& body);
/// Returns the kinetic energy per unit of mass, mean over the bodies, J/kg.
double meanKineticEnergy(std::span<btRigidBody* const> bodies);
std::uint32_t countAsleep(std::span<btRigidBody* const> bodies);

}  // namespace cairn::scenes
