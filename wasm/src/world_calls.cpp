// SPDX-License-Identifier: Zlib
//
// What JavaScript calls of worlds; wasm/js/world.mjs says what they mean.
#include <algorithm>
#include <cmath>
#include <limits>

#include "calls.h"
#include "exported.h"
#include "simulation/contact_list.h"
#include "simulation/simulation.h"

namespace {

using namespace cairn::wasm;
using namespace cairn::simulation;
using WorldHandle = std::unique_ptr<Simulation>;
using ShapeHandle = std::shared_ptr<cairn::bullet::SphereTreeShape>;

// JavaScript writes arguments of many numbers here: position (3), rotation (4) and what follows.
constexpr std::size_t kArguments = 32;
double arguments[kArguments];

btVector3 vectorAt(std::size_t first) {
  return {btScalar(arguments[first]), btScalar(arguments[first + 1]), btScalar(arguments[first + 2])};
}

Pose poseAt(std::size_t first) {
  const btVector3 axis = vectorAt(first + 3);
  return {vectorAt(first), btQuaternion(axis.x(), axis.y(), axis.z(), btScalar(arguments[first + 6]))};
}

Material materialAt(std::size_t first) {
  return {btScalar(arguments[first]), btScalar(arguments[first + 1])};
}

}  // namespace

CAIRN_WASM(double*) cairn_arguments() {
  return arguments;
}

/// Arguments: gravity (3), time step.
CAIRN_WASM(WorldHandle*) cairn_world_make() {
  return made<WorldHandle>([] { return Simulation::create(vectorAt(0), btScalar(arguments[3])); });
}

CAIRN_WASM(void) cairn_world_free(WorldHandle* world) {
  delete world;
}

/// Arguments: gravity (3).
CAIRN_WASM(int) cairn_world_gravity(WorldHandle* world) {
  return done([&] { return (*world)->setGravity(vectorAt(0)); });
}

CAIRN_WASM(int) cairn_world_iterations(WorldHandle* world, int iterations) {
  return done([&] { return (*world)->setSolverIterations(iterations); });
}

/// Arguments: operations and microseconds, infinite for no limit.
CAIRN_WASM(int) cairn_world_budget(WorldHandle* world) {
  cairn::bullet::StepBudget budget;
  if (!std::isinf(arguments[0])) budget.operations = static_cast<std::int64_t>(std::clamp(arguments[0], -1.0, 9e15));
  if (!std::isinf(arguments[1])) budget.microseconds = arguments[1];
  return done([&] { return (*world)->narrowPhase().setBudget(budget); });
}

CAIRN_WASM(void) cairn_world_unresolved(WorldHandle* world, int policy) {
  (*world)->narrowPhase().setUnresolved(static_cast<cairn::bullet::Unresolved>(policy));
}

CAIRN_WASM(void) cairn_world_finest(WorldHandle* world, int finest) {
  (*world)->narrowPhase().setFinest(static_cast<cairn::bullet::Finest>(finest));
}

/// Arguments: normal (3), offset, friction, restitution.
CAIRN_WASM(int) cairn_world_plane(WorldHandle* world) {
  return done([&] { return (*world)->addPlane(vectorAt(0), btScalar(arguments[3]), materialAt(4)); });
}

/// Arguments: half extents (3), pose (7), friction, restitution.
CAIRN_WASM(int) cairn_world_box(WorldHandle* world) {
  return done([&] { return (*world)->addBox(vectorAt(0), poseAt(3), materialAt(10)); });
}

/// Arguments: pose (7), friction, restitution, mass. The body's number, or -1.
CAIRN_WASM(int) cairn_world_body(WorldHandle* world, const ShapeHandle* shape) {
  int number = -1;
  done([&]() -> cairn::Status {
    const auto added = (*world)->addBody(*shape, btScalar(arguments[9]), poseAt(0), materialAt(7));
    if (!added) return added.error();
    number = added.value();
    return {};
  });
  return number;
}

CAIRN_WASM(int) cairn_world_remove(WorldHandle* world, int body) {
  return done([&] { return (*world)->removeBody(body); });
}

/// Arguments: pose (7).
CAIRN_WASM(int) cairn_world_pose(WorldHandle* world, int body) {
  return done([&] { return (*world)->setPose(body, poseAt(0)); });
}

/// Arguments: linear (3) and angular (3) velocity.
CAIRN_WASM(int) cairn_world_velocity(WorldHandle* world, int body) {
  return done([&] { return (*world)->setVelocity(body, vectorAt(0), vectorAt(3)); });
}

/// Arguments: point (3), target (3).
CAIRN_WASM(int) cairn_world_drag(WorldHandle* world, int body) {
  return done([&] { return (*world)->drag(body, vectorAt(0), vectorAt(3)); });
}

CAIRN_WASM(int) cairn_world_release(WorldHandle* world, int body) {
  return done([&] { return (*world)->release(body); });
}

CAIRN_WASM(int) cairn_world_step(WorldHandle* world) {
  return done([&]() -> cairn::Status {
    (*world)->step();
    return {};
  });
}

/// In the order of `StepStatistics`; an unset deadline is infinite.
CAIRN_WASM(const double*) cairn_world_statistics(WorldHandle* world) {
  const cairn::bullet::StepStatistics& s = (*world)->narrowPhase().lastStep();
  const double none = std::numeric_limits<double>::infinity();
  return leave(answer().doubles,
               {double(s.operations), s.microseconds, s.elapsedMicroseconds, s.deadlineMicroseconds.value_or(none),
                s.missedByMicroseconds, double(s.pairs), double(s.nonFinitePairs), double(s.unresolvedPairs),
                double(s.contacts), double(s.exactContacts), double(s.manifolds), s.worstErrorFraction,
                s.meanErrorFraction, s.worstSeenError, s.meanSeenError});
}

/// Twelve numbers each: point, normal (world), depth, error (m), a, b, impulse (N s), 1 where the pair was finished.
CAIRN_WASM(const float*) cairn_world_contacts(const WorldHandle* world) {
  static std::vector<Contact> contacts;  // these keep their memory from step to step
  static std::vector<float> numbers;
  listContacts(**world, contacts);
  numbers.clear();
  for (const Contact& c : contacts)
    numbers.insert(numbers.end(), {float(c.point.x()), float(c.point.y()), float(c.point.z()), float(c.normal.x()),
                                   float(c.normal.y()), float(c.normal.z()), c.depth, c.error, float(c.a), float(c.b),
                                   c.impulse, c.isResolved ? 1.0F : 0.0F});
  answer().count = numbers.size();
  return numbers.data();
}

/// Seven numbers a body: where the mesh's frame is, and its rotation x, y, z, w. NaN for removed bodies.
CAIRN_WASM(const float*) cairn_world_transforms(const WorldHandle* world) {
  static std::vector<float> transforms;
  transforms.clear();
  for (const Body& body : (*world)->bodies()) {
    if (!body.rigid) {
      transforms.insert(transforms.end(), 7, std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    const btTransform pose = body.pose();
    const btVector3& at = pose.getOrigin();
    const btQuaternion q = pose.getRotation();
    transforms.insert(transforms.end(), {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()});
  }
  answer().count = transforms.size();
  return transforms.data();
}

/// One byte a body: 1 asleep, 0 awake, 2 removed.
CAIRN_WASM(const std::uint8_t*) cairn_world_asleep(const WorldHandle* world) {
  static std::vector<std::uint8_t> asleep;
  asleep.clear();
  for (const Body& body : (*world)->bodies()) asleep.push_back(!body.rigid ? 2 : body.rigid->isActive() ? 0 : 1);
  answer().count = asleep.size();
  return asleep.data();
}

/// Linear and angular velocity, six numbers a body; zero for removed ones.
CAIRN_WASM(const float*) cairn_world_velocities(const WorldHandle* world) {
  static std::vector<float> velocities;
  velocities.clear();
  for (const Body& body : (*world)->bodies())
    for (int i = 0; i < 6; ++i) {
      const bool isTurning = i > 2;
      const btRigidBody* rigid = body.rigid.get();
      velocities.push_back(!rigid ? 0 : isTurning ? rigid->getAngularVelocity()[i - 3] : rigid->getLinearVelocity()[i]);
    }
  answer().count = velocities.size();
  return velocities.data();
}

CAIRN_WASM(const char*) cairn_world_hash(const WorldHandle* world) {
  answer().text = (*world)->stateHash();
  return answer().text.c_str();
}
