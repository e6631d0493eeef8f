// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that fly through a window in a thin wall, continuous collision on: those that touch nothing in steps so small
// that none is needed fly on as if there were no wall.
#include <gtest/gtest.h>

#include <array>
#include <iostream>
#include <random>

#include "built_shape.h"
#include "bullet_world.h"
#include "test_solids.h"
#include "triangle_grounds.h"

namespace cairn::test::window_test {
namespace {

constexpr std::uint32_t kSeed = 20054;
constexpr int kFlights = 60;
constexpr double kHalfWindow = 0.75, kThickness = 0.05;

using Shape = std::shared_ptr<btCollisionShape>;

// Two slabs beside a square hole and two above and below it; they overlap at the corners, as level geometry does.
std::array<Shape, 2> wall() {
  const double apart = 2 * kHalfWindow + 2;
  return {bvhMesh(twoCuboids({kThickness, 2, 4}, {0, apart, 0}, 4)),
          bvhMesh(twoCuboids({kThickness, 4, 2}, {0, 0, apart}, 4))};
}

struct Flight {
  btVector3 from, velocity, spin;
  btQuaternion turn;
};

// Whether it has the speed and spin it began with once it is past the wall.
bool isFree(const Shape& shape, const std::array<Shape, 2>& wall, const Flight& flight, int hertz, bool isContinuous) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  for (const Shape& slabs : wall) w.add(slabs, 0, btVector3(0, 0, 0)).setRestitution(btScalar(0.5));
  btRigidBody& body = w.add(shape, 1, flight.from, flight.turn);
  body.setRestitution(btScalar(0.5));
  body.setLinearVelocity(flight.velocity);
  body.setAngularVelocity(flight.spin);
  if (isContinuous) body.setCcdMotionThreshold(btScalar(0.1));
  const int steps = static_cast<int>(4 / flight.velocity.x() * btScalar(hertz));
  for (int i = 0; i < steps; ++i) w.world.stepSimulation(btScalar(1) / btScalar(hertz), 0);
  return (body.getLinearVelocity() - flight.velocity).length() < btScalar(1e-3) * flight.velocity.length();
}

struct Count {
  int free = 0, caught = 0;
};

Count fly(const Solid& solid, const std::array<Shape, 2>& wall, btScalar speed) {
  const Shape shape = builtShape(solid);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto draw = [&] { return btScalar(unit(random)); };
  Count count;
  for (int i = 0; i < kFlights; ++i) {
    const btScalar a = draw(), b = draw(), c = draw(), d = draw(), y = draw(), z = draw(), vy = draw(), vz = draw();
    const btScalar spin = i % 2 == 0 ? 0 : 10;
    const Flight flight{btVector3(-2, y * btScalar(0.3), z * btScalar(0.3)),
                        btVector3(speed, speed * vy / 15, speed * vz / 15), btVector3(a, b, c) * spin,
                        btQuaternion(a, b, c, d).normalized()};
    if (!isFree(shape, wall, flight, 3000, false)) continue;
    ++count.free;
    if (!isFree(shape, wall, flight, 60, true)) ++count.caught;
  }
  return count;
}

TEST(Window, CatchesNothingThatFliesThroughIt) {
  const std::array<Shape, 2> slabs = wall();
  int free = 0;
  for (const auto& [name, solid] : {std::pair{"box", cuboid({1, 0.7, 0.5}, 4)}, {"torus", torus(0.5, 0.15, 24)}})
    for (const btScalar speed : {btScalar(10), btScalar(40)}) {
      const Count count = fly(solid, slabs, speed);
      std::cout << "of " << kFlights << " flights of a " << name << " at " << speed << " m/s " << count.free
                << " are free, and " << count.caught << " of these caught\n";
      EXPECT_EQ(count.caught, 0) << "seed " << kSeed;
      free += count.free;
    }
  EXPECT_GT(free, kFlights) << "the window lets nobody through";
}

}  // namespace
}  // namespace cairn::test::window_test
