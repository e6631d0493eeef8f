// SPDX-License-Identifier: Zlib
//
// What JavaScript calls of worlds; wasm/js/world.mjs says what they mean.
#include <cmath>

#include "exported.h"
#include "world.h"

namespace {

using namespace cairn::wasm;
using namespace cairn::simulation;
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
CAIRN_WASM(World*) cairn_world_make() {
  return made<World>([]() -> cairn::Result<std::unique_ptr<Simulation>> {
    askForRoom(kRoomOfWorld);
    return Simulation::create(vectorAt(0), btScalar(arguments[3]));
  });
}

CAIRN_WASM(void) cairn_world_free(World* world) {
  delete world;
}

/// Arguments: gravity (3).
CAIRN_WASM(int) cairn_world_gravity(World* world) {
  return changed(world, [](Simulation& in) { return in.setGravity(vectorAt(0)); });
}

CAIRN_WASM(int) cairn_world_iterations(World* world, int iterations) {
  return changed(world, [&](Simulation& in) { return in.setSolverIterations(iterations); });
}

/// Arguments: operations and microseconds, infinite for no limit.
CAIRN_WASM(int) cairn_world_budget(World* world) {
  cairn::bullet::StepBudget budget;
  if (!std::isinf(arguments[0])) budget.operations = static_cast<std::int64_t>(arguments[0]);
  if (!std::isinf(arguments[1])) budget.microseconds = arguments[1];
  return grown(world, [&](Simulation& in) { return in.narrowPhase().setBudget(budget); });
}

CAIRN_WASM(int) cairn_world_unresolved(World* world, int policy) {
  return changed(world, [&](Simulation& in) -> cairn::Status {
    in.narrowPhase().setUnresolved(static_cast<cairn::bullet::Unresolved>(policy));
    return {};
  });
}

CAIRN_WASM(int) cairn_world_finest(World* world, int finest) {
  return changed(world, [&](Simulation& in) -> cairn::Status {
    in.narrowPhase().setFinest(static_cast<cairn::bullet::Finest>(finest));
    return {};
  });
}

/// Arguments: normal (3), offset, friction, restitution.
CAIRN_WASM(int) cairn_world_plane(World* world) {
  return grown(world, [](Simulation& in) { return in.addPlane(vectorAt(0), btScalar(arguments[3]), materialAt(4)); });
}

/// Arguments: half extents (3), pose (7), friction, restitution.
CAIRN_WASM(int) cairn_world_box(World* world) {
  return grown(world, [](Simulation& in) { return in.addBox(vectorAt(0), poseAt(3), materialAt(10)); });
}

/// Arguments: pose (7), friction, restitution, mass. The body's number, or -1.
CAIRN_WASM(int) cairn_world_body(World* world, const ShapeHandle* shape) {
  int number = -1;
  grown(world, [&](Simulation& in) -> cairn::Status {
    const auto added = in.addBody(*shape, btScalar(arguments[9]), poseAt(0), materialAt(7));
    if (!added) return added.error();
    number = added.value();
    return {};
  });
  return number;
}

CAIRN_WASM(int) cairn_world_remove(World* world, int body) {
  return changed(world, [&](Simulation& in) { return in.removeBody(body); });
}

/// Arguments: pose (7).
CAIRN_WASM(int) cairn_world_pose(World* world, int body) {
  return grown(world, [&](Simulation& in) { return in.setPose(body, poseAt(0)); });
}

/// Arguments: linear (3) and angular (3) velocity.
CAIRN_WASM(int) cairn_world_velocity(World* world, int body) {
  return changed(world, [&](Simulation& in) { return in.setVelocity(body, vectorAt(0), vectorAt(3)); });
}

/// Arguments: point (3), target (3).
CAIRN_WASM(int) cairn_world_drag(World* world, int body) {
  return grown(world, [&](Simulation& in) { return in.drag(body, vectorAt(0), vectorAt(3)); });
}

CAIRN_WASM(int) cairn_world_release(World* world, int body) {
  return changed(world, [&](Simulation& in) { return in.release(body); });
}

CAIRN_WASM(int) cairn_world_step(World* world) {
  return grown(world, [](Simulation& in) -> cairn::Status {
    in.step();
    return {};
  });
}
