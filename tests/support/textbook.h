// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cairn/effects/friction.h"
#include "cairn/effects/gyroscopic.h"
#include "cairn/effects/restitution.h"
#include "cairn/effects/rolling_resistance.h"
#include "slope_world.h"

namespace cairn::test {

/// The bodies of the textbook's experiments in one kind of shape. Masses are of the solids the textbook means, so that
/// only collision differs.
struct TextbookShapes {
  std::string name;
  std::shared_ptr<btCollisionShape> ball;   ///< radius 0.5
  std::shared_ptr<btCollisionShape> slab;   ///< 1 x 1 x 0.2
  std::shared_ptr<btCollisionShape> tower;  ///< 0.5 x 0.5 x 1
};

/// The result of one experiment.
struct TextbookResult {
  std::string experiment, quantity;
  double exact = 0, measured = 0;
  double scale = 0;  ///< errors are parts of this
  double microsecondsPerStep = 0;

  double error() const { return std::abs(measured - exact) / scale; }
};

namespace textbook {

inline constexpr btScalar kRadius = btScalar(0.5), kStepsPerSecond = 240;
inline constexpr double g = 9.81;

inline btVector3 ballInertia() {
  const btScalar moment = btScalar(0.4) * kRadius * kRadius;
  return {moment, moment, moment};
}
inline btVector3 boxInertia(const btVector3& size) {
  const btVector3 squares = size * size;
  return btVector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()) / 12;
}
inline const btVector3 kSlab(1, 1, btScalar(0.2)), kTower(btScalar(0.5), btScalar(0.5), 1);

/// A world of one step length, its effects, and a clock.
class Bench {
 public:
  explicit Bench(btScalar slope = 0, btScalar friction = btScalar(0.5), btScalar restitution = 0)
      : world(slope, kStepsPerSecond), slope_(slope) {
    world.add<effects::Friction>(effects::PairTable<btScalar>(friction));
    world.add<effects::Restitution>(effects::PairTable<btScalar>(restitution), effects::restitution::Constant{});
  }

  /// A body of a kilogram set down on the ground, its axes turned with the slope.
  btRigidBody& put(const std::shared_ptr<btCollisionShape>& shape, const btVector3& inertia, btScalar height,
                   btScalar mass = 1) {
    btRigidBody& body = world.addBody(shape, mass, up() * height);
    body.setMassProps(mass, inertia * mass);
    body.setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), slope_), up() * height));
    body.updateInertiaTensor();
    return body;
  }
  btVector3 up() const { return {btSin(slope_), 0, btCos(slope_)}; }
  btVector3 along() const { return {btCos(slope_), 0, -btSin(slope_)}; }

  void run(double seconds) {
    const auto start = std::chrono::steady_clock::now();
    world.run(btScalar(seconds));
    microseconds_ += std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    steps_ += seconds * double(kStepsPerSecond);
  }
  double microsecondsPerStep() const { return microseconds_ / steps_; }
  double wayOf(const btRigidBody& body) const { return double(body.getWorldTransform().getOrigin().dot(along())); }
  double speedOf(const btRigidBody& body) const { return double(body.getLinearVelocity().dot(along())); }

  SlopeWorld world;

 private:
  btScalar slope_;
  double microseconds_ = 0, steps_ = 0;
};

inline TextbookResult freeFall(const TextbookShapes& shapes) {
  Bench bench;
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), 20);
  bench.run(1);
  // Bullet adds a step's gravity before it moves a body.
  const double steps = double(kStepsPerSecond), way = g / (steps * steps) * steps * (steps + 1) / 2;
  return {"R1", "fallen in 1 s, m",         way, 20 - double(ball.getWorldTransform().getOrigin().z()),
          way,  bench.microsecondsPerStep()};
}

inline TextbookResult slides(const TextbookShapes& shapes) {
  const double angle = 30 * double(SIMD_RADS_PER_DEG), a = g * (std::sin(angle) - 0.3 * std::cos(angle));
  Bench bench(btScalar(angle), btScalar(0.3));
  btRigidBody& slab = bench.put(shapes.slab, boxInertia(kSlab), kSlab.z() / 2);
  bench.run(1);  // settles
  const double before = bench.speedOf(slab);
  bench.run(1);
  return {"R2", "slides at, m/s2", a, bench.speedOf(slab) - before, a, bench.microsecondsPerStep()};
}

inline TextbookResult sticks(const TextbookShapes& shapes) {
  Bench bench(btAtan(btScalar(0.5)), btScalar(0.55));
  btRigidBody& slab = bench.put(shapes.slab, boxInertia(kSlab), kSlab.z() / 2);
  const double start = bench.wayOf(slab);
  bench.run(5);
  return {"R3", "sticks for 5 s, m", 0, bench.wayOf(slab) - start, 1, bench.microsecondsPerStep()};
}

inline TextbookResult stops(const TextbookShapes& shapes) {
  constexpr double kSpeed = 5, kFriction = 0.4;
  Bench bench(0, btScalar(kFriction));
  btRigidBody& slab = bench.put(shapes.slab, boxInertia(kSlab), kSlab.z() / 2);
  bench.run(0.5);
  const double start = bench.wayOf(slab), way = kSpeed * kSpeed / (2 * kFriction * g);
  slab.setLinearVelocity(btVector3(btScalar(kSpeed), 0, 0));
  bench.run(3);
  return {"R4", "slides to rest in, m", way, bench.wayOf(slab) - start, way, bench.microsecondsPerStep()};
}

inline TextbookResult rolls(const TextbookShapes& shapes) {
  const double angle = 30 * double(SIMD_RADS_PER_DEG), a = 5.0 / 7 * g * std::sin(angle);
  Bench bench(btScalar(angle), btScalar(0.8));
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), kRadius);
  bench.run(1);
  const double before = bench.speedOf(ball);
  bench.run(1);
  return {"R5", "rolls at, m/s2", a, bench.speedOf(ball) - before, a, bench.microsecondsPerStep()};
}

inline TextbookResult beginsToRoll(const TextbookShapes& shapes) {
  Bench bench(0, btScalar(0.3));
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), kRadius);
  bench.run(0.5);
  ball.setLinearVelocity(btVector3(7, 0, 0));
  bench.run(0.75);
  return {"R6", "slides, then rolls at, m/s", 5, bench.speedOf(ball), 5, bench.microsecondsPerStep()};
}

inline TextbookResult rollsToRest(const TextbookShapes& shapes) {
  constexpr double kArm = 0.05, kSpeed = 2, way = kSpeed * kSpeed / (2 * 5.0 / 7 * g * kArm / 0.5);
  Bench bench(0, btScalar(0.8));
  bench.world.add<effects::RollingResistance>(
      effects::PairTable<effects::RollingResistance::Lengths>({.rolling = btScalar(kArm)}));
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), kRadius);
  bench.run(0.5);
  const double start = bench.wayOf(ball);
  ball.setLinearVelocity(btVector3(btScalar(kSpeed), 0, 0));
  ball.setAngularVelocity(btVector3(0, btScalar(kSpeed) / kRadius, 0));
  bench.run(6);
  return {"R7", "rolls to rest in, m", way, bench.wayOf(ball) - start, way, bench.microsecondsPerStep()};
}

inline TextbookResult bounces(const TextbookShapes& shapes) {
  constexpr double kHeight = 10, kRestitution = 0.5;
  Bench bench(0, btScalar(0.5), btScalar(kRestitution));
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), kRadius + btScalar(kHeight));
  double highest = 0;
  const double landing = std::sqrt(2 * kHeight / g);
  bench.run(landing + 0.05);
  for (int i = 0; i < 2 * int(kStepsPerSecond); ++i) {
    bench.run(1 / double(kStepsPerSecond));
    highest = std::max(highest, double(ball.getWorldTransform().getOrigin().z() - kRadius));
  }
  return {"R8", "bounces to, m", kHeight / 4, highest, kHeight / 4, bench.microsecondsPerStep()};
}

/// A ball that strikes the ground at an angle, friction as given: the speed along it afterwards.
inline TextbookResult obliqueBlow(const TextbookShapes& shapes, double friction, const std::string& what) {
  constexpr double kDown = 6, kAlong = 4, kRestitution = 0.5;
  Bench bench(0, btScalar(friction), btScalar(kRestitution));
  btRigidBody& ball = bench.put(shapes.ball, ballInertia(), kRadius + btScalar(0.1));
  ball.setLinearVelocity(btVector3(btScalar(kAlong), 0, btScalar(-kDown)));
  bench.run(0.05);
  const bool grips = friction >= 2 * kAlong / (7 * (1 + kRestitution) * kDown);
  const double exact = grips ? 5.0 / 7 * kAlong : kAlong - friction * (1 + kRestitution) * kDown;
  return {"R9", what, exact, bench.speedOf(ball), kAlong, bench.microsecondsPerStep()};
}

/// On an incline 3 degrees to either side of a boundary: 1 if it did what it must, else 0. Stays: moves by less than 5
/// cm in 3 s; slides: goes on by more, upright; topples: its top has turned by more than 30 degrees.
inline TextbookResult onIncline(const TextbookShapes& shapes) {
  struct Case {
    bool isTower;
    double degrees, friction;
    char expected;
  };
  const double boundary = std::atan(0.5) / double(SIMD_RADS_PER_DEG);
  const std::vector<Case> cases{{true, boundary - 3, 0.8, 'r'},
                                {true, boundary + 3, 0.8, 't'},
                                {false, boundary - 3, 0.5, 'r'},
                                {false, boundary + 3, 0.5, 's'}};
  double right = 0, microseconds = 0;
  for (const Case& c : cases) {
    Bench bench(radians(btScalar(c.degrees)), btScalar(c.friction));
    const btVector3& size = c.isTower ? kTower : kSlab;
    btRigidBody& body = bench.put(c.isTower ? shapes.tower : shapes.slab, boxInertia(size), size.z() / 2);
    const btVector3 start = body.getWorldTransform().getOrigin();
    bench.run(3);
    const double turned =
        std::acos(std::min(1.0, double((body.getWorldTransform().getBasis() * btVector3(0, 0, 1)).dot(bench.up()))));
    const double way = double((body.getWorldTransform().getOrigin() - start).length());
    const char did = turned > 0.5 ? 't' : way > 0.05 ? 's' : 'r';
    right += did == c.expected ? 1 : 0;
    microseconds += bench.microsecondsPerStep() / double(cases.size());
  }
  const auto count = double(cases.size());
  return {"R10", "right of 4 on inclines", count, right, count, microseconds};
}

/// A ball meets one of three times its mass at rest, restitution 0.8, nothing else acts: its speed afterwards.
inline TextbookResult twoBalls(const TextbookShapes& shapes) {
  constexpr double kSpeed = 4, kRestitution = 0.8, kTimes = 3;
  Bench bench(0, 0, btScalar(kRestitution));
  bench.world.bullet.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& first = bench.put(shapes.ball, ballInertia(), 5);
  btRigidBody& second = bench.put(shapes.ball, ballInertia(), 5, btScalar(kTimes));
  for (btRigidBody* ball : {&first, &second}) ball->setGravity(btVector3(0, 0, 0));
  second.translate(btVector3(btScalar(1.5), 0, 0));
  first.setLinearVelocity(btVector3(btScalar(kSpeed), 0, 0));
  bench.run(0.5);
  const double exact = kSpeed * (1 - kRestitution * kTimes) / (1 + kTimes);
  return {"R11", "thrown back at, m/s", exact, bench.speedOf(first), kSpeed, bench.microsecondsPerStep()};
}

/// A box that spins about its middle axis, nothing else acts: what is left of its angular momentum after 10 s.
inline TextbookResult spins(const TextbookShapes& shapes) {
  Bench bench(0, 0);
  bench.world.add<effects::Gyroscopic>(effects::Gyroscopic::Options{});
  bench.world.bullet.world.setGravity(btVector3(0, 0, 0));
  const btVector3 size(btScalar(0.2), btScalar(0.5), 1), inertia = boxInertia(size);
  btRigidBody& body = bench.put(shapes.tower, inertia, 5);
  body.setGravity(btVector3(0, 0, 0));
  body.setAngularVelocity(btVector3(btScalar(0.01), 5, btScalar(0.01)));
  const auto momentum = [&] {
    const btVector3 spin = body.getWorldTransform().getBasis().transpose() * body.getAngularVelocity();
    return double((spin * inertia).length());
  };
  const double before = momentum();
  bench.run(10);
  return {"R12", "angular momentum left", 1, momentum() / before, 1, bench.microsecondsPerStep()};
}

inline std::vector<std::function<TextbookResult(const TextbookShapes&)>> experiments() {
  const auto grips = [](const TextbookShapes& s) { return obliqueBlow(s, 0.6, "grips, then goes at, m/s"); };
  const auto slips = [](const TextbookShapes& s) { return obliqueBlow(s, 0.05, "slips, then goes at, m/s"); };
  return {freeFall, slides, sticks, stops,     rolls,    beginsToRoll, rollsToRest,
          bounces,  grips,  slips,  onIncline, twoBalls, spins};
}

}  // namespace textbook
}  // namespace cairn::test
