// SPDX-License-Identifier: Zlib
// Pairs that fly: no answer lasts, and there is too little to finish them. They are answered from the level reached.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::coarse_look_test {
namespace {

constexpr unsigned kSeed = 7;
constexpr double kStep = 1.0 / 60;
constexpr int kSteps = 40;
constexpr double kBeads[] = {-0.6, -0.2, 0.2, 0.6}, kRadius = 0.16;

// Balls in a row: how deep two rows are in each other is known.
Solid beads() {
  Solid row;
  for (const double x : kBeads) {
    const Solid bead = ball(kRadius, 8);
    const auto first = static_cast<std::uint32_t>(row.vertices.size());
    for (const Vec3d& v : bead.vertices) row.vertices.push_back(v + Vec3d(x, 0, 0));
    for (const auto& t : bead.triangles) row.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return row;
}

double depthOf(const btRigidBody& x, const btRigidBody& y) {
  double deepest = 0;
  for (const double a : kBeads)
    for (const double b : kBeads) {
      const btVector3 apart =
          x.getWorldTransform() * btVector3(btScalar(a), 0, 0) - y.getWorldTransform() * btVector3(btScalar(b), 0, 0);
      deepest = std::max(deepest, 2 * kRadius - double(apart.length()));
    }
  return deepest;
}

struct Flight {
  btVector3 from, velocity, axis;
  double turn;
};

std::vector<Flight> flights(std::mt19937_64& engine, int bodies) {
  std::vector<Flight> all;
  const auto any = [&](double most) { return btScalar(uniform(engine, -most, most)); };
  for (int i = 0; i < bodies; ++i) {
    const btVector3 from = btVector3(any(1), any(1), any(1)).normalized() * btScalar(1);
    all.push_back(
        {from, -from * btScalar(0.02), btVector3(any(1), any(1), any(1)).normalized(), uniform(engine, 0.005, 0.015)});
  }
  return all;
}

// Bodies that are moved by hand, at the speed they have.
struct Flock {
  BulletWorld<> w;
  std::vector<btRigidBody*> bodies;

  explicit Flock(std::size_t count) {
    w.world.setGravity(btVector3(0, 0, 0));
    w.world.getDispatchInfo().m_timeStep = btScalar(kStep);
    const auto shape = treeShape(plainTree(beads(), 12));
    for (std::size_t i = 0; i < count; ++i) bodies.push_back(&w.add(shape, 1, btVector3(5 * btScalar(i), 0, 0)));
  }

  void show(const std::vector<Flight>& flights, int step) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Flight& f = flights[i];
      bodies[i]->setWorldTransform(
          btTransform(btQuaternion(f.axis, btScalar(f.turn * step)), f.from + f.velocity * btScalar(step)));
      bodies[i]->setLinearVelocity(f.velocity / btScalar(kStep));
      bodies[i]->setAngularVelocity(f.axis * btScalar(f.turn / kStep));
    }
    w.world.performDiscreteCollisionDetection();
  }

  bool isTold() const {
    int points = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i)
      points += w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
    return points > 0;
  }
};

double sizeOf(const Flock& flock) {
  return double(static_cast<const bullet::SphereTreeShape*>(flock.bodies[0]->getCollisionShape())->size());
}

// The worst certified error of a step, on average.
double worstErrorOf(const std::vector<Flight>& flights, std::int64_t operations) {
  Flock flock(flights.size());
  EXPECT_TRUE(flock.w.dispatcher.setBudget({operations, {}}).ok());
  double sum = 0;
  for (int step = 0; step < kSteps; ++step) {
    flock.show(flights, step);
    sum += flock.w.dispatcher.lastStep().worstErrorFraction;
  }
  return sum / kSteps;
}

// Some ninety operations for each of the 91 pairs there can be. Before, those that came last were left to the spheres
// of whole bodies.
TEST(CoarseLook, LeavesNoFlyingPairToTheSpheresOfWholeBodies) {
  std::mt19937_64 engine(kSeed);
  const std::vector<Flight> flown = flights(engine, 14);
  const double whole = worstErrorOf(flown, 0);
  EXPECT_LT(worstErrorOf(flown, 8000), 0.7 * whole);
}

TEST(CoarseLook, ErrsLessTheMoreItIsGiven) {
  std::mt19937_64 engine(kSeed);
  const std::vector<Flight> flown = flights(engine, 14);
  double before = worstErrorOf(flown, 500);
  for (const std::int64_t operations : {2000, 8000, 32000}) {
    const double now = worstErrorOf(flown, operations);
    EXPECT_LE(now, before) << operations << " operations";
    before = now;
  }
  EXPECT_LT(before, 0.5 * worstErrorOf(flown, 500));
}

// The reported error holds, however old a traversal is; no deeper pair stays without contacts.
TEST(CoarseLook, IsSilentAboutNothingDeeperThanItsError) {
  std::mt19937_64 engine(kSeed);
  int deep = 0;
  for (int run = 0; run < 120; ++run)
    for (const std::int64_t operations : {150, 600, 2000, 5000}) {
      const std::vector<Flight> flown = flights(engine, 2);
      Flock flock(2);
      ASSERT_TRUE(flock.w.dispatcher.setBudget({operations, {}}).ok());
      for (int step = 0; step < kSteps; ++step) {
        flock.show(flown, step);
        const double depth = depthOf(*flock.bodies[0], *flock.bodies[1]);
        const double error = flock.w.dispatcher.lastStep().worstErrorFraction * sizeOf(flock);
        if (depth <= error) continue;
        ++deep;
        EXPECT_TRUE(flock.isTold()) << "seed " << kSeed << ", run " << run << ", " << operations << " operations, step "
                                    << step << ": " << depth << " m deep, " << error;
      }
    }
  EXPECT_GT(deep, 100) << "hardly any was so deep: the test shows nothing";
}

}  // namespace
}  // namespace cairn::test::coarse_look_test
