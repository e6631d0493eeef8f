// SPDX-License-Identifier: Zlib
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/core/result.h"
#include "simulation/objects.h"

namespace cairn::simulation {

/// A Bullet world of sphere-trees between planes and boxes, which owns all that is in it. Bodies have numbers from 0
/// on; the number of a removed body is given to the next one. Units are metres, kilograms and seconds.
class Simulation {
 public:
  /// Fails for a time step or gravity out of range (ranges.h), as all functions do for numbers that are.
  static Result<std::unique_ptr<Simulation>> create(const btVector3& gravity, btScalar timeStep);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// The acceleration of all bodies from now on; wakes them.
  Status setGravity(const btVector3& gravity);
  /// Passes of the contact solver over all contacts in a step, at least 1; 10 at first.
  Status setSolverIterations(int iterations);
  /// Budget, policies and statistics of the narrow phase.
  bullet::Dispatcher<>& narrowPhase() { return dispatcher_; }
  const bullet::Dispatcher<>& narrowPhase() const { return dispatcher_; }
  /// The world that all this is in.
  btDiscreteDynamicsWorld& world() { return world_; }

  /// Adds the half-space of points whose product with `normal` is below `offset`.
  Status addPlane(const btVector3& normal, btScalar offset, const Material& material);
  /// Adds a box that does not move.
  Status addBox(const btVector3& halfExtents, const Pose& pose, const Material& material);
  /// Adds a body and returns its number. A mass of 0 makes it immovable.
  Result<int> addBody(std::shared_ptr<bullet::SphereTreeShape> shape, btScalar mass, const Pose& pose,
                      const Material& material);
  Status removeBody(int number);

  /// Puts a body elsewhere and wakes it. Its velocities stay.
  Status setPose(int number, const Pose& pose);
  /// Velocities of the centre of mass, m/s and rad/s; wakes the body.
  Status setVelocity(int number, const btVector3& linear, const btVector3& angular);
  /// Holds a body: its `point` (mesh frame, metres) is pulled to `target` (world) in every step until `release`. The
  /// pull never exceeds `kStrongestPull`.
  Status drag(int number, const btVector3& point, const btVector3& target);
  /// Lets a body go.
  Status release(int number);

  /// One step of the world's time step.
  void step();

  /// The body of a number. Fails where there is none.
  Result<const Body*> body(int number) const;
  /// By number; those of removed bodies have no rigid body.
  const std::vector<Body>& bodies() const { return bodies_; }
  /// Sixteen hexadecimal digits over places, rotations and velocities of everything, in the order it was added.
  std::string stateHash() const;

 private:
  Simulation(const btVector3& gravity, btScalar timeStep);
  Result<Body*> bodyOf(int number);
  Status addObstacle(std::unique_ptr<btCollisionShape> shape, const Pose& pose, const Material& material);
  int freeNumber();
  void wakeNeighbours(const btRigidBody& body);

  btScalar timeStep_;
  btDefaultCollisionConfiguration configuration_;
  bullet::Dispatcher<> dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<Obstacle> obstacles_;
  std::vector<Body> bodies_;
  std::vector<const btRigidBody*> inOrder_;  // of being added
  btDiscreteDynamicsWorld world_;
};

/// The greatest acceleration that a drag gives a body, m/s^2: enough to throw it, not enough to press it through
/// others.
inline constexpr btScalar kStrongestPull = 200;

}  // namespace cairn::simulation
