// SPDX-License-Identifier: Zlib
// Bodies that break: what breaks off when, and that mass, momentum and energy are kept.
#include "cairn/effects/fragmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/effects/restitution.h"
#include "slope_world.h"
#include "test_solids.h"
#include "test_trees.h"

namespace cairn::test::fragmentation_test {
namespace {

using effects::Fragmentation;
using effects::FragmentBody;
using effects::FragmentPart;
using effects::Fragments;

constexpr btScalar kDensity = 2600;

// A bar of four cubes of 1 m in a row along x, which is a kind of body with four pieces; the first and last hang on one
// neighbour each.
Solid cubeAt(double x) {
  Solid solid = cuboid({1, 1, 1}, 2);
  for (Vec3d& v : solid.vertices) v.x += x;
  return solid;
}
std::shared_ptr<const SphereTree> treeOf(const Solid& solid) {
  return plainTree(solid);
}
std::shared_ptr<const Fragments> bar() {
  auto kind = std::make_shared<Fragments>();
  for (const double x : {-1.5, -0.5, 0.5, 1.5}) kind->pieces.push_back(treeOf(cubeAt(x)));
  kind->bonds = {{0, 1}, {1, 2}, {2, 3}};
  return kind;
}

struct Barred {
  SlopeWorld world;
  std::shared_ptr<const Fragments> kind = bar();
  std::unique_ptr<bullet::SphereTreeShape> shape;
  FragmentPart part;
  btRigidBody* body = nullptr;
  Fragmentation* effect = nullptr;

  explicit Barred(btScalar energyPerMass, btScalar height = 5, btScalar scale = 1) {
    shape = std::move(
                bullet::SphereTreeShape::create(treeOf(cuboid({4, 1, 1}, 4)), bullet::BodyFrame::principalAxes, scale))
                .value();
    part = FragmentPart::whole(kind, *shape, kDensity);
    world.add<effects::Restitution>(effects::PairTable<btScalar>(btScalar(0.3)), effects::restitution::Constant{});
    effect = &world.add<Fragmentation>(Fragmentation::Options{.energyPerMass = energyPerMass});
    const btScalar mass = kDensity * 4 * scale * scale * scale;
    // Unowned by the world: it is the tests'.
    body = &world.addBody(std::shared_ptr<btCollisionShape>(shape.get(), [](btCollisionShape*) {}), mass,
                          btVector3(0, 0, height + btScalar(0.5) * scale));
    effect->setBreakable(0, part);
  }
};

struct Sums {
  double mass = 0, energy = 0;
  Vec3d momentum{0, 0, 0}, angular{0, 0, 0};

  void add(double m, const btVector3& inertia, const btTransform& pose, const btVector3& v, const btVector3& w) {
    const btMatrix3x3& axes = pose.getBasis();
    const btVector3 local = axes.transpose() * w, spin = axes * (local * inertia);
    mass += m;
    energy += m * double(v.length2()) / 2 + double((local * inertia).dot(local)) / 2;
    const btVector3 p = v * btScalar(m), l = pose.getOrigin().cross(p) + spin;
    momentum = momentum + Vec3d{double(p.x()), double(p.y()), double(p.z())};
    angular = angular + Vec3d{double(l.x()), double(l.y()), double(l.z())};
  }
};

Sums sumsOf(const btRigidBody& body) {
  Sums sums;
  const btVector3 inverse = body.getInvInertiaDiagLocal();
  sums.add(1 / double(body.getInvMass()), btVector3(1 / inverse.x(), 1 / inverse.y(), 1 / inverse.z()),
           body.getWorldTransform(), body.getLinearVelocity(), body.getAngularVelocity());
  return sums;
}

// Sums of float products of some terms each: relative to the whole.
constexpr double kTolerance = 1e-5;

TEST(Fragments, BreakingOffKeepsMassMomentumAndEnergy) {
  for (const btScalar scale : {btScalar(1), btScalar(0.3)}) {
    Barred barred(1, 5, scale);
    btRigidBody& body = *barred.body;
    body.setWorldTransform(
        btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.7)), btVector3(1, -2, 7)));
    body.setLinearVelocity(btVector3(3, -4, 5));
    body.setAngularVelocity(btVector3(2, 1, -3));
    body.updateInertiaTensor();
    const Sums before = sumsOf(body);
    for (std::uint32_t piece = 0; piece < 4; ++piece) {
      auto bodies = effects::breakOff(body, barred.part, piece);
      ASSERT_TRUE(bodies) << bodies.error().message;
      EXPECT_EQ(bodies.value().size(), piece == 0 || piece == 3 ? 2U : 3U) << "inner pieces part the others";
      EXPECT_EQ(bodies.value().front().part.pieces, std::vector<std::uint32_t>{piece});
      Sums after;
      for (const FragmentBody& b : bodies.value())
        after.add(double(b.mass), b.inertia, b.pose, b.linearVelocity, b.angularVelocity);
      EXPECT_NEAR(after.mass / before.mass, 1, kTolerance);
      EXPECT_NEAR(after.energy / before.energy, 1, kTolerance);
      EXPECT_LT(length(after.momentum - before.momentum), kTolerance * length(before.momentum));
      EXPECT_LT(length(after.angular - before.angular), kTolerance * length(before.angular));
    }
  }
}

TEST(Fragments, PiecesStandWhereTheyWere) {
  Barred barred(1);
  barred.body->setWorldTransform(
      btTransform(btQuaternion(btVector3(1, 2, 3).normalized(), btScalar(0.7)), btVector3(1, -2, 7)));
  auto bodies = effects::breakOff(*barred.body, barred.part, 0);
  ASSERT_TRUE(bodies);
  const btTransform worldFromMesh = barred.body->getWorldTransform() * barred.part.bodyFromMesh;
  const FragmentBody &piece = bodies.value()[0], &rest = bodies.value()[1];
  EXPECT_LT((piece.pose.getOrigin() - worldFromMesh * btVector3(btScalar(-1.5), 0, 0)).length(), 1e-5);
  EXPECT_LT((rest.pose.getOrigin() - worldFromMesh * btVector3(btScalar(0.5), 0, 0)).length(), 1e-5);
  btVector3 lower, upper, wholeLower, wholeUpper;
  rest.shape().getAabb(rest.pose, lower, upper);
  barred.shape->getAabb(barred.body->getWorldTransform(), wholeLower, wholeUpper);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(lower[axis], wholeLower[axis] - btScalar(0.1));
    EXPECT_LE(upper[axis], wholeUpper[axis] + btScalar(0.1));
  }
}

TEST(Fragments, TheNearestPieceIsTheOneThere) {
  Barred barred(1);
  const btTransform worldFromMesh = barred.body->getWorldTransform() * barred.part.bodyFromMesh;
  for (std::uint32_t piece = 0; piece < 4; ++piece)
    EXPECT_EQ(effects::nearestPiece(*barred.body, barred.part,
                                    worldFromMesh * btVector3(btScalar(piece) - btScalar(1.5), 0, btScalar(-0.5))),
              piece);
}

/// Lands flat after a fall of `height`; the energy of its blow per mass, as the effect saw it.
std::vector<effects::Break> breaksAfterFall(btScalar energyPerMass, btScalar height) {
  Barred barred(energyPerMass, height);
  barred.world.run(btScalar(1.3));
  return barred.effect->takeBreaks();
}

TEST(Fragmentation, BreaksAboveTheThresholdAndNotBelow) {
  constexpr btScalar kHeight = 5, kSpecific = kGravity * kHeight;
  // The blow's speed is that of a step more or less.
  const btScalar tolerance = btSqrt(2 * kGravity * kHeight) * 2 * kGravity / 240;
  EXPECT_TRUE(breaksAfterFall(kSpecific + tolerance, kHeight).empty());
  const auto breaks = breaksAfterFall(kSpecific - tolerance, kHeight);
  ASSERT_EQ(breaks.size(), 1U);
  EXPECT_NEAR(breaks.front().energyPerMass, kSpecific, tolerance);
  // Exactly: the same fall against a threshold of just what it brings, and of a hair less.
  const btScalar exact = breaks.front().energyPerMass;
  EXPECT_TRUE(breaksAfterFall(exact, kHeight).empty());
  EXPECT_EQ(breaksAfterFall(std::nextafter(exact, btScalar(0)), kHeight).size(), 1U);
}

TEST(Fragmentation, TheStruckEndBreaksOff) {
  Barred barred(1);
  barred.body->setWorldTransform(
      btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(0.4)), btVector3(0, 0, 4)));  // +x end down
  barred.world.run(btScalar(1));
  const auto breaks = barred.effect->takeBreaks();
  ASSERT_FALSE(breaks.empty());
  const btVector3 end = barred.body->getWorldTransform() * btVector3(2, 0, 0);
  EXPECT_EQ(breaks.front().piece, 3U) << end.z();
}

/// Replaces what broke, as a scene does.
void replaceBroken(Barred& barred, std::vector<FragmentBody>& made, std::vector<btRigidBody*>& bodies) {
  for (const effects::Break& broken : barred.effect->takeBreaks()) {
    const FragmentPart part = *barred.effect->partOf(broken.bodyId);
    auto parts = effects::breakOff(*broken.body, part, broken.piece);
    ASSERT_TRUE(parts);
    barred.world.set().removeBody(*broken.body);
    std::erase(bodies, broken.body);
    barred.world.bullet.remove(*broken.body);
    std::vector<std::uint32_t> siblings;
    for (FragmentBody& b : parts.value()) {
      btRigidBody& body = barred.world.bullet.add(
          std::shared_ptr<btCollisionShape>(&b.shape(), [](btCollisionShape*) {}), b.mass, b.pose.getOrigin());
      body.setMassProps(b.mass, b.inertia);
      body.setWorldTransform(b.pose);
      body.updateInertiaTensor();
      body.setLinearVelocity(b.linearVelocity);
      body.setAngularVelocity(b.angularVelocity);
      const std::uint32_t id = barred.world.set().addBody(body, {.material = kRock, .volume = b.volume});
      barred.effect->setBreakable(id, b.part, broken.generation + 1);
      bodies.push_back(&body);
      made.push_back(std::move(b));
      siblings.push_back(id);
    }
    barred.effect->setSiblings(siblings);
  }
}

double energyOf(const std::vector<btRigidBody*>& bodies) {
  double energy = 0;
  for (const btRigidBody* body : bodies)
    energy += sumsOf(*body).energy +
              double(kGravity) * double(body->getWorldTransform().getOrigin().z()) / double(body->getInvMass());
  return energy;
}

TEST(Fragmentation, EnergyNeverRisesWhileBodiesBreakAgainAndAgain) {
  Barred barred(3, 6);
  barred.body->setWorldTransform(btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(0.5)), btVector3(0, 0, 8)));
  barred.body->setAngularVelocity(btVector3(0, 2, 1));
  std::vector<FragmentBody> made;
  std::vector<btRigidBody*> bodies{barred.body};
  const double start = energyOf(bodies);
  double least = start;
  std::size_t most = 1;
  for (int i = 0; i < 1200; ++i) {
    barred.world.runStep();
    replaceBroken(barred, made, bodies);
    const double now = energyOf(bodies);
    EXPECT_LE(now, least + 0.005 * start) << "step " << i;
    least = std::min(least, now);
    most = std::max(most, bodies.size());
  }
  EXPECT_GE(most, 2U);
  double mass = 0;
  for (const btRigidBody* body : bodies) mass += 1 / double(body->getInvMass());
  EXPECT_NEAR(mass / (4.0 * double(kDensity)), 1, kTolerance);
  std::printf("%zu bodies, energy %.4f of the start\n", bodies.size(), energyOf(bodies) / start);
  for (btRigidBody* body : bodies) barred.world.set().removeBody(*body);
  for (btRigidBody* body : bodies) barred.world.bullet.remove(*body);
}

TEST(Fragmentation, GenerationsEnd) {
  Barred barred(1);
  auto& effect = barred.world.add<Fragmentation>(Fragmentation::Options{.energyPerMass = 0, .maxGenerations = 1});
  effect.setBreakable(0, barred.part, 1);
  EXPECT_EQ(effect.partOf(0), nullptr);
  effect.setBreakable(0, barred.part, 0);
  EXPECT_NE(effect.partOf(0), nullptr);
}

}  // namespace
}  // namespace cairn::test::fragmentation_test
