// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/world.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <algorithm>
#include <cassert>

#include "scenes/world/timed_dispatcher.h"

namespace cairn::scenes {
namespace {

constexpr btScalar kFriction = btScalar(0.5);

}  // namespace

Result<std::unique_ptr<World>> World::create(const WorldOptions& options) {
  auto world = std::unique_ptr<World>(new World(options));
  if (world->treeDispatcher_) {
    if (const Status status = world->treeDispatcher_->setBudget(options.budget); !status) return status.error();
    if (const Status status = world->treeDispatcher_->setViewer(options.viewer); !status) return status.error();
  }
  return world;
}

Status World::setBudget(const bullet::StepBudget& budget) {
  return treeDispatcher_ ? treeDispatcher_->setBudget(budget) : Status{};
}

World::World(const WorldOptions& options) : options_(options) {
  makeDispatcher();
  world_ = std::make_unique<btDiscreteDynamicsWorld>(dispatcher_.get(), &broadphase_, &solver_, &configuration_);
  world_->setGravity({0, 0, -static_cast<btScalar>(options.gravity)});
}

void World::makeDispatcher() {
  if (isSphereTree(options_.shape)) {
    auto dispatcher = std::make_unique<TimedDispatcher<TreeDispatcher>>(narrowPhaseCpuUs_, &configuration_);
    dispatcher->setUnresolved(options_.unresolved);
    if (options_.shape == ShapeKind::treeLeaves) dispatcher->setFinest(bullet::Finest::leaves);
    dispatcher->setPriority(makePriority(options_.priority));
    treeDispatcher_ = dispatcher.get();
    dispatcher_ = std::move(dispatcher);
    return;
  }
  dispatcher_ = std::make_unique<TimedDispatcher<btCollisionDispatcher>>(narrowPhaseCpuUs_, &configuration_);
  if (options_.shape == ShapeKind::gimpact) btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher_.get());
}

World::~World() {
  for (const auto& body : bodies_) world_->removeRigidBody(body.get());
}

btRigidBody& World::addBody(btCollisionShape& shape, const btTransform& pose, btScalar mass, const btVector3& inertia) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform = pose;
  info.m_friction = kFriction;
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  btRigidBody& body = *bodies_.back();
  if (!options_.sleeping) body.setActivationState(DISABLE_DEACTIVATION);
  if (mass > 0) {
    body.setUserIndex(static_cast<int>(moving_.size()));
    moving_.push_back(&body);
  } else {
    body.setUserIndex(staticNumber(bodies_.size() - 1 - moving_.size()));
  }
  world_->addRigidBody(&body);
  return body;
}

StepRecord World::step() {
  narrowPhaseCpuUs_ = 0;
  const double start = threadCpuMicroseconds();
  const auto timeStep = static_cast<btScalar>(options_.timeStep);
  world_->stepSimulation(timeStep, 1, timeStep);
  const double stepCpuUs = threadCpuMicroseconds() - start;
  loads_.update(*dispatcher_);
  return record(stepCpuUs);
}

StepRecord World::show(std::span<const BodyMotion> motions) {
  assert(motions.size() == moving_.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    moving_[i]->setCenterOfMassTransform(motions[i].pose);
    moving_[i]->setLinearVelocity(motions[i].linearVelocity);
    moving_[i]->setAngularVelocity(motions[i].angularVelocity);
  }
  narrowPhaseCpuUs_ = 0;
  world_->getDispatchInfo().m_timeStep = static_cast<btScalar>(options_.timeStep);
  const double start = threadCpuMicroseconds();
  world_->performDiscreteCollisionDetection();
  return record(threadCpuMicroseconds() - start);
}

StepRecord World::record(double stepCpuUs) const {
  StepRecord record;
  record.stepCpuUs = stepCpuUs;
  record.narrowPhaseCpuUs = narrowPhaseCpuUs_;
  record.manifolds = static_cast<std::uint32_t>(dispatcher_->getNumManifolds());
  for (int i = 0; i < dispatcher_->getNumManifolds(); ++i)
    record.contacts += static_cast<std::uint32_t>(dispatcher_->getManifoldByIndexInternal(i)->getNumContacts());
  if (treeDispatcher_) record.tree = treeDispatcher_->lastStep();
  return record;
}

std::vector<ReportedContact> World::contacts() const {
  std::vector<ReportedContact> contacts;
  for (int i = 0; i < dispatcher_->getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_->getManifoldByIndexInternal(i);
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      const btManifoldPoint& point = manifold.getContactPoint(c);
      contacts.push_back({manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex(),
                          fromBullet(point.getPositionWorldOnA()), fromBullet(point.getPositionWorldOnB())});
    }
  }
  return contacts;
}

std::vector<BodyMotion> World::motions() const {
  std::vector<BodyMotion> motions;
  for (const btRigidBody* body : moving_)
    motions.push_back({body->getWorldTransform(), body->getLinearVelocity(), body->getAngularVelocity()});
  return motions;
}

std::vector<btTransform> World::poses() const {
  std::vector<btTransform> poses;
  for (const btRigidBody* body : moving_) poses.push_back(body->getWorldTransform());
  return poses;
}

void World::addState(StateHash& hash) const {
  const auto add = [&](const btVector3& v) {
    for (int axis = 0; axis < 3; ++axis) hash.add(v[axis]);
  };
  for (const btRigidBody* body : moving_) {
    add(body->getWorldTransform().getOrigin());
    for (int row = 0; row < 3; ++row) add(body->getWorldTransform().getBasis()[row]);
    add(body->getLinearVelocity());
    add(body->getAngularVelocity());
  }
}

double fastestSpeed(std::span<btRigidBody* const> bodies) {
  double fastest = 0;
  for (const btRigidBody* body : bodies)
    fastest = std::max(fastest, static_cast<double>(body->getLinearVelocity().length()));
  return fastest;
}

double kineticEnergy(const btRigidBody& body) {
  const btVector3 spin = body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity();
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  double twice = static_cast<double>(body.getLinearVelocity().length2()) / static_cast<double>(body.getInvMass());
  for (int axis = 0; axis < 3; ++axis)
    twice += static_cast<double>(spin[axis]) * static_cast<double>(spin[axis]) / static_cast<double>(inverse[axis]);
  return twice / 2;
}

double meanKineticEnergy(std::span<btRigidBody* const> bodies) {
  double sum = 0;
  for (const btRigidBody* body : bodies) sum += kineticEnergy(*body) * static_cast<double>(body->getInvMass());
  return bodies.empty() ? 0 : sum / static_cast<double>(bodies.size());
}

std::uint32_t countAsleep(std::span<btRigidBody* const> bodies) {
  return static_cast<std::uint32_t>(
      std::count_if(bodies.begin(), bodies.end(), [](const btRigidBody* body) { return !body->isActive(); }));
}

}  // namespace cairn::scenes
