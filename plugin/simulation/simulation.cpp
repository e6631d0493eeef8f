// SPDX-License-Identifier: Zlib
#include "simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cairn/core/state_hash.h"
#include "simulation/ranges.h"

namespace cairn::simulation {

namespace {

Status check(const Pose& pose) {
  if (Status status = check(kPlaces, pose.position, "the position"); !status) return status;
  const btScalar length = pose.rotation.length();
  if (!(std::abs(length - 1) < btScalar(1e-3)))
    return Error{"the rotation is no unit quaternion; give x, y, z and w of length 1"};
  return {};
}

Status check(const Material& material) {
  if (Status status = check(kFrictions, material.friction, "the friction"); !status) return status;
  return check(kRestitutions, material.restitution, "the restitution");
}

// Unchanged where it is a unit already: rounding would change bits.
btTransform transformOf(const Pose& pose) {
  const btScalar squared = pose.rotation.length2();
  return btTransform(squared == 1 ? pose.rotation : pose.rotation / btSqrt(squared), pose.position);
}

std::unique_ptr<btRigidBody> rigidBody(btCollisionShape& shape, btScalar mass, const btTransform& start,
                                       const Material& material) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform = start;
  info.m_friction = material.friction;
  info.m_restitution = material.restitution;
  return std::make_unique<btRigidBody>(info);
}

// What moves a body on, and where it is.
void addState(StateHash& hash, const btRigidBody& body) {
  const btTransform& t = body.getWorldTransform();
  for (int i = 0; i < 3; ++i) {
    hash.add(t.getOrigin()[i]);
    hash.add(body.getLinearVelocity()[i]);
    for (int j = 0; j < 3; ++j) hash.add(t.getBasis()[i][j]);
  }
}

}  // namespace

Result<std::unique_ptr<Simulation>> Simulation::create(const btVector3& gravity, btScalar timeStep) {
  if (const Status status = check(kTimeSteps, timeStep, "the time step"); !status) return status.error();
  std::unique_ptr<Simulation> made(new Simulation({0, 0, 0}, timeStep));
  if (const Status status = made->setGravity(gravity); !status) return status.error();
  return made;
}

Simulation::Simulation(const btVector3& gravity, btScalar timeStep)
    : timeStep_(timeStep), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  world_.setGravity(gravity);
}

Simulation::~Simulation() {
  for (Body& body : bodies_)
    if (body.drag) world_.removeConstraint(body.drag.get());
  for (int i = world_.getNumCollisionObjects(); i-- > 0;)
    world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
}

Status Simulation::setGravity(const btVector3& gravity) {
  if (Status status = check(kGravities, gravity, "gravity"); !status) return status;
  for (const Body& body : bodies_)
    if (body.rigid) body.rigid->activate();
  world_.setGravity(gravity);  // Bullet passes over bodies that sleep
  return {};
}

Status Simulation::setSolverIterations(int iterations) {
  if (iterations < 1 || iterations > kMaxIterations)
    return Error{"the solver cannot iterate " + std::to_string(iterations) + " times; give 1 to " +
                 std::to_string(kMaxIterations)};
  world_.getSolverInfo().m_numIterations = iterations;
  return {};
}

Status Simulation::addObstacle(std::unique_ptr<btCollisionShape> shape, const Pose& pose, const Material& material) {
  if (const Status status = check(pose); !status) return status;
  if (const Status status = check(material); !status) return status;
  auto rigid = rigidBody(*shape, 0, transformOf(pose), material);
  rigid->setUserIndex(-1 - static_cast<int>(obstacles_.size()));
  obstacles_.push_back({std::move(shape), std::move(rigid)});
  world_.addRigidBody(obstacles_.back().rigid.get());
  inOrder_.push_back(obstacles_.back().rigid.get());
  return {};
}

Status Simulation::addPlane(const btVector3& normal, btScalar offset, const Material& material) {
  const btScalar length = normal.length();
  if (Status status = check(kNormalLengths, length, "the length of a plane's normal"); !status) return status;
  if (Status status = check(kPlaces, offset / length, "a plane's offset over its normal's length"); !status)
    return status;
  auto shape = std::make_unique<btStaticPlaneShape>(length == 1 ? normal : normal / length, offset / length);
  return addObstacle(std::move(shape), {}, material);
}

Status Simulation::addBox(const btVector3& halfExtents, const Pose& pose, const Material& material) {
  if (Status status = check(kHalfExtents, halfExtents, "half a box's extent"); !status) return status;
  return addObstacle(std::make_unique<btBoxShape>(halfExtents), pose, material);
}

int Simulation::freeNumber() {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].rigid) return static_cast<int>(i);
  bodies_.emplace_back();
  return static_cast<int>(bodies_.size()) - 1;
}

Result<int> Simulation::addBody(std::shared_ptr<bullet::SphereTreeShape> shape, btScalar mass, const Pose& pose,
                                const Material& material) {
  if (const Status status = check(kSizes, btScalar(shape->size()), "the body's size"); !status) return status.error();
  if (mass != 0)
    if (const Status status = check(kMasses, mass, "the mass"); !status) return status.error();
  if (const Status status = check(pose); !status) return status.error();
  if (const Status status = check(material); !status) return status.error();
  const int number = freeNumber();
  Body& body = bodies_[static_cast<std::size_t>(number)];
  body.rigid = rigidBody(*shape, mass, transformOf(pose) * shape->bodyFromMesh().inverse(), material);
  body.rigid->setUserIndex(number);
  body.shape = std::move(shape);
  world_.addRigidBody(body.rigid.get());
  inOrder_.push_back(body.rigid.get());
  return number;
}

Result<const Body*> Simulation::body(int number) const {
  const auto index = static_cast<std::size_t>(number);
  if (number < 0 || index >= bodies_.size() || !bodies_[index].rigid)
    return Error{"there is no body " + std::to_string(number) + "; give a number that was returned when one was added"};
  return &bodies_[index];
}

Result<Body*> Simulation::bodyOf(int number) {
  const Result<const Body*> found = body(number);
  if (!found) return found.error();
  return &bodies_[static_cast<std::size_t>(number)];
}

// Bullet leaves bodies asleep whose support is taken away.
void Simulation::wakeNeighbours(const btRigidBody& body) {
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    if (manifold.getBody0() == &body) manifold.getBody1()->activate();
    if (manifold.getBody1() == &body) manifold.getBody0()->activate();
  }
}

Status Simulation::removeBody(int number) {
  const Result<Body*> found = bodyOf(number);
  if (!found) return found.error();
  if (const Status status = release(number); !status) return status;
  Body& body = *found.value();
  wakeNeighbours(*body.rigid);
  world_.removeRigidBody(body.rigid.get());
  std::erase(inOrder_, body.rigid.get());
  body = {};
  return {};
}

Status Simulation::setPose(int number, const Pose& pose) {
  const Result<Body*> found = bodyOf(number);
  if (!found) return found.error();
  if (const Status status = check(pose); !status) return status;
  const Body& body = *found.value();
  wakeNeighbours(*body.rigid);
  body.rigid->setWorldTransform(transformOf(pose) * body.shape->bodyFromMesh().inverse());
  body.rigid->setInterpolationWorldTransform(body.rigid->getWorldTransform());
  world_.updateSingleAabb(body.rigid.get());
  body.rigid->activate();
  return {};
}

Status Simulation::setVelocity(int number, const btVector3& linear, const btVector3& angular) {
  const Result<Body*> found = bodyOf(number);
  if (!found) return found.error();
  if (Status status = check(kVelocities, linear, "the velocity"); !status) return status;
  if (Status status = check(kVelocities, angular, "the angular velocity"); !status) return status;
  btRigidBody& rigid = *found.value()->rigid;
  rigid.setLinearVelocity(linear);
  rigid.setAngularVelocity(angular);
  rigid.activate();
  return {};
}

Status Simulation::drag(int number, const btVector3& point, const btVector3& target) {
  const Result<Body*> found = bodyOf(number);
  if (!found) return found.error();
  Body& body = *found.value();
  if (body.rigid->getInvMass() == 0)
    return Error{"body " + std::to_string(number) + " has no mass; drag one that moves"};
  if (Status status = check(kPlaces, point, "the point of a drag"); !status) return status;
  if (Status status = check(kPlaces, target, "the target of a drag"); !status) return status;
  const btVector3 held = body.shape->bodyFromMesh() * point;
  if (!body.drag) {
    body.drag = std::make_unique<btPoint2PointConstraint>(*body.rigid, held);
    body.drag->m_setting.m_impulseClamp = kStrongestPull * timeStep_ / body.rigid->getInvMass();
    world_.addConstraint(body.drag.get());
  }
  body.drag->setPivotA(held);
  body.drag->setPivotB(target);
  body.rigid->activate(true);
  return {};
}

Status Simulation::release(int number) {
  const Result<Body*> found = bodyOf(number);
  if (!found) return found.error();
  Body& body = *found.value();
  if (!body.drag) return {};
  world_.removeConstraint(body.drag.get());
  body.drag.reset();
  body.rigid->activate(true);
  return {};
}

void Simulation::step() {
  for (const Body& body : bodies_)
    if (body.drag) body.rigid->activate(true);
  world_.stepSimulation(timeStep_, 0);
}

std::string Simulation::stateHash() const {
  StateHash hash;
  for (const btRigidBody* body : inOrder_) addState(hash, *body);
  return hash.hex();
}

}  // namespace cairn::simulation
