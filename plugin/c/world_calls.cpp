// SPDX-License-Identifier: Zlib
//
// Worlds in C; cairn/cairn.h says what the calls mean.
#include <algorithm>
#include <array>
#include <cstring>

#include "c/calls.h"
#include "simulation/contact_list.h"

using cairn::Status;
using cairn::c::done;
using cairn::c::made;
using cairn::simulation::Body;
using cairn::simulation::Material;
using cairn::simulation::Pose;
using cairn::simulation::Simulation;

namespace {

btVector3 vector(const float* numbers) {
  return {btScalar(numbers[0]), btScalar(numbers[1]), btScalar(numbers[2])};
}

void write(const btVector3& v, float* numbers) {
  for (int axis = 0; axis < 3; ++axis) numbers[axis] = float(v[axis]);
}

void write(const cairn::simulation::Contact& contact, CairnContact& written) {
  write(contact.point, written.point);
  write(contact.normal, written.normal);
  written.depth = contact.depth;
  written.error = contact.error;
  written.impulse = contact.impulse;
  written.a = contact.a;
  written.b = contact.b;
  written.isResolved = contact.isResolved ? 1 : 0;
}

Pose pose(const CairnPose& p) {
  const float* const q = p.rotation;
  return {vector(p.position), btQuaternion(btScalar(q[0]), btScalar(q[1]), btScalar(q[2]), btScalar(q[3]))};
}

Material material(const CairnMaterial* m) {
  return m ? Material{btScalar(m->friction), btScalar(m->restitution)} : Material{};
}

// The body of a number; null, with a sentence left, where there is none.
const Body* find(const CairnWorld* world, int32_t number) {
  const Body* body = nullptr;
  done([&]() -> Status {
    const auto found = world->simulation->body(number);
    if (!found) return found.error();
    body = found.value();
    return {};
  });
  return body;
}

}  // namespace

CairnWorldOptions cairnUsualWorld(void) {
  return {{0, -9.81F, 0}, 1.0F / 60, 10};
}

CairnWorld* cairnMakeWorld(const CairnWorldOptions* given) {
  const CairnWorldOptions options = given ? *given : cairnUsualWorld();
  return made<CairnWorld>([&]() -> cairn::Result<std::unique_ptr<Simulation>> {
    auto simulation = Simulation::create(vector(options.gravity), btScalar(options.timeStep));
    if (!simulation) return simulation.error();
    if (const Status status = simulation.value()->setSolverIterations(options.solverIterations); !status)
      return status.error();
    return simulation;
  });
}

void cairnFreeWorld(CairnWorld* world) {
  delete world;
}

void* cairnBulletWorld(CairnWorld* world) {
  return &world->simulation->world();
}

int cairnSetGravity(CairnWorld* world, const float gravity[3]) {
  return done([&] { return world->simulation->setGravity(vector(gravity)); });
}

int cairnSetBudget(CairnWorld* world, const CairnBudget* budget) {
  cairn::bullet::StepBudget limits;
  if (budget->operations != CAIRN_NO_LIMIT) limits.operations = budget->operations;
  if (budget->microseconds != CAIRN_NO_LIMIT) limits.microseconds = budget->microseconds;
  return done([&] { return world->simulation->narrowPhase().setBudget(limits); });
}

int cairnSetUnresolved(CairnWorld* world, int32_t policy) {
  return done([&]() -> Status {
    if (policy < CAIRN_GUARD || policy > CAIRN_COMPENSATE)
      return cairn::Error{"there is no policy " + std::to_string(policy) + "; give one of CairnUnresolved"};
    world->simulation->narrowPhase().setUnresolved(static_cast<cairn::bullet::Unresolved>(policy));
    return {};
  });
}

int cairnSetFinest(CairnWorld* world, int32_t finest) {
  return done([&]() -> Status {
    if (finest != CAIRN_LEAVES && finest != CAIRN_TRIANGLES)
      return cairn::Error{"refinement cannot end at " + std::to_string(finest) + "; give one of CairnFinest"};
    world->simulation->narrowPhase().setFinest(static_cast<cairn::bullet::Finest>(finest));
    return {};
  });
}

int cairnAddPlane(CairnWorld* world, const float normal[3], float offset, const CairnMaterial* surface) {
  return done([&] { return world->simulation->addPlane(vector(normal), btScalar(offset), material(surface)); });
}

int cairnAddBox(CairnWorld* world, const float halfExtents[3], const CairnPose* at, const CairnMaterial* surface) {
  return done([&] { return world->simulation->addBox(vector(halfExtents), pose(*at), material(surface)); });
}

int32_t cairnAddBody(CairnWorld* world, const CairnShape* shape, float mass, const CairnPose* at,
                     const CairnMaterial* surface) {
  int number = -1;
  done([&]() -> Status {
    const auto added = world->simulation->addBody(shape->shape, btScalar(mass), pose(*at), material(surface));
    if (!added) return added.error();
    number = added.value();
    return {};
  });
  return number;
}

int cairnRemoveBody(CairnWorld* world, int32_t body) {
  return done([&] { return world->simulation->removeBody(body); });
}

int cairnSetPose(CairnWorld* world, int32_t body, const CairnPose* at) {
  return done([&] { return world->simulation->setPose(body, pose(*at)); });
}

int cairnSetVelocity(CairnWorld* world, int32_t body, const float linear[3], const float angular[3]) {
  return done([&] { return world->simulation->setVelocity(body, vector(linear), vector(angular)); });
}

int cairnDragBody(CairnWorld* world, int32_t body, const float point[3], const float target[3]) {
  return done([&] { return world->simulation->drag(body, vector(point), vector(target)); });
}

int cairnReleaseBody(CairnWorld* world, int32_t body) {
  return done([&] { return world->simulation->release(body); });
}

int cairnStep(CairnWorld* world) {
  return done([&]() -> Status {
    world->simulation->step();
    return {};
  });
}

void cairnLastStep(const CairnWorld* world, CairnStatistics* statistics) {
  const cairn::bullet::StepStatistics& s = world->simulation->narrowPhase().lastStep();
  *statistics = {s.operations,
                 s.microseconds,
                 s.elapsedMicroseconds,
                 s.deadlineMicroseconds.value_or(CAIRN_NO_LIMIT),
                 s.missedByMicroseconds,
                 s.pairs,
                 s.nonFinitePairs,
                 s.unresolvedPairs,
                 s.contacts,
                 s.exactContacts,
                 s.manifolds,
                 s.worstErrorFraction,
                 s.meanErrorFraction};
}

int32_t cairnBodyCount(const CairnWorld* world) {
  return static_cast<int32_t>(world->simulation->bodies().size());
}

int cairnGetPose(const CairnWorld* world, int32_t number, CairnPose* result) {
  const Body* const body = find(world, number);
  if (!body) return 0;
  const btTransform at = body->pose();
  const btQuaternion rotation = at.getRotation();
  write(at.getOrigin(), result->position);
  for (int i = 0; i < 4; ++i) result->rotation[i] = float(rotation[i]);
  return 1;
}

int cairnGetVelocity(const CairnWorld* world, int32_t number, float linear[3], float angular[3]) {
  const Body* const body = find(world, number);
  if (!body) return 0;
  write(body->rigid->getLinearVelocity(), linear);
  write(body->rigid->getAngularVelocity(), angular);
  return 1;
}

int cairnIsAsleep(const CairnWorld* world, int32_t number) {
  const Body* const body = find(world, number);
  if (!body) return -1;
  return body->rigid->isActive() ? 0 : 1;
}

size_t cairnContacts(const CairnWorld* world, CairnContact* contacts, size_t room) {
  std::size_t count = 0;
  done([&]() -> Status {
    thread_local std::vector<cairn::simulation::Contact> listed;  // keeps its memory from step to step
    cairn::simulation::listContacts(*world->simulation, listed);
    count = listed.size();
    for (std::size_t i = 0; i < std::min(count, room); ++i) write(listed[i], contacts[i]);
    return {};
  });
  return count;
}

void cairnStateHash(const CairnWorld* world, char hash[17]) {
  std::memset(hash, 0, 17);
  done([&]() -> Status {
    std::memcpy(hash, world->simulation->stateHash().c_str(), 17);
    return {};
  });
}
