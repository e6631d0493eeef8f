// SPDX-License-Identifier: Zlib
#include "simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cairn/core/state_hash.h"

namespace cairn::simulation {

namespace {

bool isFinite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

Status check(const Pose& pose) {
  if (!isFinite(pose.position)) return Error{"the position is not three finite numbers; give x, y and z in metres"};
  const btScalar length = pose.rotation.length();
  if (!(std::abs(length - 1) < btScalar(1e-3)))
    return Error{"the rotation is no unit quaternion; give x, y, z and w of length 1"};
  return {};
}

Status check(const Material& material) {
  if (material.friction >= 0 && std::isfinite(material.friction) && material.restitution >= 0 &&
      std::isfinite(material.restitution))
    return {};
  return Error{"friction or restitution is negative or not finite; give numbers from 0 on"};
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
  if (!(timeStep > 0 && std::isfinite(timeStep)))
    return Error{"the time step is not positive and finite; give seconds, such as 1/60"};
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
  if (!isFinite(gravity)) return Error{"gravity is not three finite numbers; give x, y and z in m/s^2"};
  for (const Body& body : bodies_)
    if (body.rigid) body.rigid->activate();
  world_.setGravity(gravity);  // Bullet passes over bodies that sleep
  return {};
}

Status Simulation::setSolverIterations(int iterations) {
  if (iterations < 1) return Error{"the solver needs at least one iteration; give a number from 1 on"};
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
  if (!(length > 0 && std::isfinite(length) && std::isfinite(offset)))
    return Error{"a plane needs a finite normal that is not zero, and a finite offset"};
  auto shape = std::make_unique<btStaticPlaneShape>(length == 1 ? normal : normal / length, offset / length);
  return addObstacle(std::move(shape), {}, material);
}

Status Simulation::addBox(const btVector3& halfExtents, const Pose& pose, const Material& material) {
  const btScalar least = std::min({halfExtents.x(), halfExtents.y(), halfExtents.z()});
  if (!(least > 0 && isFinite(halfExtents)))
    return Error{"a box's half extents are not positive and finite; give three lengths in metres"};
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
  if (!(mass >= 0 && std::isfinite(mass))) return Error{"the mass is negative or not finite; give kilograms"};
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
  if (!isFinite(linear) || !isFinite(angular))
    return Error{"a velocity is not three finite numbers; give m/s and rad/s"};
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
  if (!isFinite(target) || !isFinite(point))
    return Error{
        "a drag's point or target is not three finite numbers; give places in the mesh's frame and in the world"};
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
