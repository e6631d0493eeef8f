// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/converge.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

constexpr double kTimeStep = 1.0 / 60;
/// Seconds until a body alone would reach the centre.
constexpr double kEarliest = 5.0 / 3, kLatest = 10.0 / 3;
constexpr double kFastestSpin = 2;  // rad/s

/// Twenty bodies of 1 m start on a sphere of 3 m. More bodies get a larger sphere, so that they always fill a fifth of
/// it.
double startRadius(const Model& model, std::uint32_t bodies) {
  constexpr double kShareTaken = 0.2;
  return std::max(3 * model.size, model.reach * std::sqrt(bodies / (4 * kShareTaken)));
}

/// The start of one body, and its undisturbed flight.
struct Flight {
  Vec3d start, velocity, spinAxis;
  double spin = 0;
  btQuaternion orientation;

  BodyMotion at(double time) const {
    const btQuaternion turn(toBullet(spinAxis), static_cast<btScalar>(spin * time));
    return {btTransform((turn * orientation).normalized(), toBullet(start + velocity * time)), toBullet(velocity),
            toBullet(spinAxis * spin)};
  }
};

std::vector<Flight> startingFlights(const Model& model, const ConvergeOptions& options, std::uint32_t run) {
  const double radius = startRadius(model, options.bodies);
  std::vector<Flight> flights;
  for (std::uint32_t i = 0; i < options.bodies; ++i) {
    Random random(options.seed, (static_cast<std::uint64_t>(run) << 32) + i);
    Flight flight;
    const auto touches = [&](const Flight& other) { return distance(flight.start, other.start) < 2 * model.reach; };
    do flight.start = random.direction() * radius;
    while (std::ranges::any_of(flights, touches));
    flight.velocity = flight.start * (-1 / random.uniform(kEarliest, kLatest));
    flight.spinAxis = random.direction();
    flight.spin = random.uniform(0, kFastestSpin);
    flight.orientation = random.rotation();
    flights.push_back(flight);
  }
  return flights;
}

void recordThrough(const std::vector<Flight>& flights, std::uint32_t frames, std::vector<BodyMotion>& motions) {
  for (std::uint32_t frame = 0; frame < frames; ++frame)
    for (const Flight& flight : flights) motions.push_back(flight.at(frame * kTimeStep));
}

Status recordBounce(const Model& model, const std::vector<Flight>& flights, std::uint32_t frames,
                    std::vector<BodyMotion>& motions) {
  WorldOptions options;
  options.shape = ShapeKind::gimpact;
  options.sleeping = false;
  options.timeStep = kTimeStep;
  options.gravity = 0;
  auto shape = BodyShape::create(options.shape, model, {});
  if (!shape) return shape.error();
  auto world = World::create(options);
  if (!world) return world.error();
  for (const Flight& flight : flights) {
    const BodyMotion motion = flight.at(0);
    btRigidBody& body = world.value()->addBody(shape.value()->bullet(), motion.pose, 1, model.inertia);
    body.setLinearVelocity(motion.linearVelocity);
    body.setAngularVelocity(motion.angularVelocity);
  }
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    const std::vector<BodyMotion> now = world.value()->motions();
    motions.insert(motions.end(), now.begin(), now.end());
    world.value()->step();
  }
  return {};
}

}  // namespace

Result<Meeting> parseMeeting(std::string_view name) {
  for (const Meeting meeting : {Meeting::through, Meeting::bounce})
    if (name == meetingName(meeting)) return meeting;
  return Error{"there is no meeting '" + std::string(name) + "': use through or bounce"};
}

const char* meetingName(Meeting meeting) {
  return meeting == Meeting::through ? "through" : "bounce";
}

std::span<const BodyMotion> Recording::frame(std::uint32_t run, std::uint32_t frame) const {
  assert(run < runs && frame < framesPerRun);
  const std::size_t number = static_cast<std::size_t>(run) * framesPerRun + frame;
  return std::span(motions).subspan(number * bodies, bodies);
}

std::string Recording::hash() const {
  StateHash hash;
  const auto add = [&](const btVector3& v) {
    for (int axis = 0; axis < 3; ++axis) hash.add(v[axis]);
  };
  for (const BodyMotion& motion : motions) {
    add(motion.pose.getOrigin());
    for (int row = 0; row < 3; ++row) add(motion.pose.getBasis()[row]);
    add(motion.linearVelocity);
    add(motion.angularVelocity);
  }
  return hash.hex();
}

Result<Recording> recordConverge(const Model& model, const ConvergeOptions& options) {
  assert(options.bodies > 0 && options.runs > 0);
  Recording recording{options.bodies, options.runs, options.frames, {}};
  for (std::uint32_t run = 0; run < options.runs; ++run) {
    const std::vector<Flight> flights = startingFlights(model, options, run);
    if (options.meeting == Meeting::through) {
      recordThrough(flights, options.frames, recording.motions);
    } else if (Status recorded = recordBounce(model, flights, options.frames, recording.motions); !recorded) {
      return recorded.error();
    }
  }
  return recording;
}

}  // namespace cairn::scenes
