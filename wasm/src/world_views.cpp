// SPDX-License-Identifier: Zlib
//
// What JavaScript reads of worlds; wasm/js/world.mjs says what it means.
#include <limits>

#include "exported.h"
#include "simulation/contact_list.h"
#include "world.h"

namespace {

using namespace cairn::wasm;
using namespace cairn::simulation;

void appendPose(const Body& body, std::vector<float>& list) {
  if (!body.rigid) {
    list.insert(list.end(), 7, std::numeric_limits<float>::quiet_NaN());
    return;
  }
  const btTransform pose = body.pose();
  const btVector3& at = pose.getOrigin();
  const btQuaternion q = pose.getRotation();
  list.insert(list.end(), {at.x(), at.y(), at.z(), q.x(), q.y(), q.z(), q.w()});
}

void appendVelocity(const Body& body, std::vector<float>& list) {
  for (int i = 0; i < 6; ++i) {
    const bool isTurning = i > 2;
    const btRigidBody* rigid = body.rigid.get();
    list.push_back(!rigid ? 0 : isTurning ? rigid->getAngularVelocity()[i - 3] : rigid->getLinearVelocity()[i]);
  }
}

}  // namespace

/// In the order of `StepStatistics`; an unset deadline is infinite.
CAIRN_WASM(const double*) cairn_world_statistics(const World* world) {
  std::vector<double>& list = answer().doubles;
  return read(world, list, [&](const Simulation& in) {
    const cairn::bullet::StepStatistics& s = in.narrowPhase().lastStep();
    const double none = std::numeric_limits<double>::infinity();
    list = {double(s.operations),     s.microseconds,
            s.elapsedMicroseconds,    s.deadlineMicroseconds.value_or(none),
            s.missedByMicroseconds,   double(s.pairs),
            double(s.nonFinitePairs), double(s.unresolvedPairs),
            double(s.contacts),       double(s.exactContacts),
            double(s.manifolds),      s.worstErrorFraction,
            s.meanErrorFraction,      s.worstSeenError,
            s.meanSeenError};
  });
}

/// Twelve numbers each: point, normal (world), depth, error (m), a, b, impulse (N s), 1 where the pair was finished.
CAIRN_WASM(const float*) cairn_world_contacts(const World* world) {
  static std::vector<Contact> contacts;  // these keep their memory from step to step
  static std::vector<float> numbers;
  return read(world, numbers, [](const Simulation& in) {
    listContacts(in, contacts);
    for (const Contact& c : contacts)
      numbers.insert(numbers.end(), {float(c.point.x()), float(c.point.y()), float(c.point.z()), float(c.normal.x()),
                                     float(c.normal.y()), float(c.normal.z()), c.depth, c.error, float(c.a), float(c.b),
                                     c.impulse, c.isResolved ? 1.0F : 0.0F});
  });
}

/// Seven numbers a body: where the mesh's frame is, and its rotation x, y, z, w. NaN for removed bodies.
CAIRN_WASM(const float*) cairn_world_transforms(const World* world) {
  static std::vector<float> transforms;
  return read(world, transforms, [](const Simulation& in) {
    for (const Body& body : in.bodies()) appendPose(body, transforms);
  });
}

/// One byte a body: 1 asleep, 0 awake, 2 removed.
CAIRN_WASM(const std::uint8_t*) cairn_world_asleep(const World* world) {
  static std::vector<std::uint8_t> asleep;
  return read(world, asleep, [](const Simulation& in) {
    for (const Body& body : in.bodies()) asleep.push_back(!body.rigid ? 2 : body.rigid->isActive() ? 0 : 1);
  });
}

/// Linear and angular velocity, six numbers a body; zero for removed ones.
CAIRN_WASM(const float*) cairn_world_velocities(const World* world) {
  static std::vector<float> velocities;
  return read(world, velocities, [](const Simulation& in) {
    for (const Body& body : in.bodies()) appendVelocity(body, velocities);
  });
}

/// The hash's characters, without an end.
CAIRN_WASM(const char*) cairn_world_hash(const World* world) {
  static std::vector<char> text;
  return read(world, text, [](const Simulation& in) {
    const std::string hash = in.stateHash();
    text.assign(hash.begin(), hash.end());
  });
}
