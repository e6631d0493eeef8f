// SPDX-License-Identifier: Zlib
// Flat pieces that fell a little way into each other, askew: their whole faces overlap, on one side deeper than on the
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "extruded.h"
#include "triangle_grounds.h"
#include "turned.h"

namespace cairn::test::tilted_overlap_test {
namespace {

constexpr double kThick = 0.04, kHalf = 0.2;  // metres

struct Flat {
  std::string name;
  Solid solid;
};

// Each lies between heights 0 and `kThick`.
std::vector<Flat> flatPieces() {
  const double r = kHalf;
  return {{"plate", extruded({{-r, -r}, {r, -r}, {r, r}, {-r, r}}, 0, kThick)},
          {"disc", extruded(circle(r, 24), 0, kThick)},
          {"corner", extruded({{-r, -r}, {r, -r}, {r, 0}, {0, 0}, {0, r}, {-r, r}}, 0, kThick)},
          {"frame", holedBlock(r, 0.1, 8, 0, kThick)},
          {"ring", turnedAround({{0.05, 0}, {r, 0}, {r, kThick}, {0.05, kThick}}, 20)}};
}

btTransform centred(const bullet::SphereTreeShape& shape, const btTransform& mesh) {
  return mesh * shape.bodyFromMesh().inverse();
}

std::shared_ptr<bullet::SphereTreeShape> shapeOf(const Solid& solid) {
  return std::move(bullet::SphereTreeShape::create(plainTree(solid, 4), bullet::BodyFrame::principalAxes)).value();
}

// Horizontal places of the points at which the upper body is held up.
struct HeldAt final : btCollisionWorld::ContactResultCallback {
  std::vector<btVector3> places;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    constexpr btScalar kUpright = btScalar(0.99);
    if (btFabs(point.m_normalWorldOnB.z()) > kUpright) places.push_back(point.getPositionWorldOnB());
    return 0;
  }
  // How far the points reach beyond the axis in the direction in which they reach least: negative if the body would
  // tip.
  double leastReach() const {
    constexpr int kDirections = 64;
    double least = 1;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      double reach = -1;
      for (const btVector3& p : places)
        reach = std::max(reach, std::cos(angle) * double(p.x()) + std::sin(angle) * double(p.y()));
      least = std::min(least, reach);
    }
    return least;
  }
};

// Where a flat piece lies in one below it: at its shallowest corner 0.2 to 1 mm deep, at its deepest up to a fifth of
// its thickness.
btTransform askew(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double shallow = 2e-4 + 8e-4 * unit(random), deep = shallow + (kThick / 5 - shallow) * unit(random);
  const double tilt = (deep - shallow) / (2 * std::numbers::sqrt2 * kHalf), way = 2 * std::numbers::pi * unit(random);
  const btQuaternion tilted(btVector3(btScalar(std::cos(way)), btScalar(std::sin(way)), 0), btScalar(tilt));
  const btQuaternion turned(btVector3(0, 0, 1), btScalar(2 * std::numbers::pi * unit(random)));
  return btTransform(tilted * turned, btVector3(0, 0, btScalar(-(shallow + deep) / 2)));
}

enum class Below { twin, box, hull, mesh };

// A block wider than the pieces.
constexpr double kHalfBlock = 2 * kHalf;

std::shared_ptr<btCollisionShape> shapeBelow(Below below, const Flat& flat) {
  if (below == Below::twin) return shapeOf(flat.solid);
  if (below == Below::mesh) return bvhMesh(cuboid({2 * kHalfBlock, 2 * kHalfBlock, 2 * kHalfBlock}, 3));
  const auto half = btScalar(kHalfBlock);
  if (below == Below::box) return std::make_shared<btBoxShape>(btVector3(half, half, half));
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 8; ++i)
    hull->addPoint(btVector3(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half));
  hull->setMargin(0);
  return hull;
}

class TiltedOverlap : public testing::TestWithParam<Below> {};

// Contacts of the shallow side count too: without them the deep side turns the upper piece over the shallow one.
TEST_P(TiltedOverlap, IsHeldOnAllSides) {
  constexpr unsigned kSeed = 1127;
  constexpr int kPoses = 60;
  std::mt19937 random(kSeed);
  for (const Flat& flat : flatPieces()) {
    const auto shape = shapeOf(flat.solid);
    BulletWorld<> w;
    const btTransform top(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(-kThick)));
    const bool isTwin = GetParam() == Below::twin;
    const btTransform below =
        isTwin ? centred(*shape, top) : btTransform(top.getBasis(), {0, 0, btScalar(-kHalfBlock)});
    btRigidBody& lower = w.add(shapeBelow(GetParam(), flat), 0, below.getOrigin(), below.getRotation());
    btRigidBody& upper = w.add(shape, 1, btVector3(0, 0, 1));
    int tipping = 0;
    for (int pose = 0; pose < kPoses; ++pose) {
      upper.setWorldTransform(centred(*shape, askew(random)));
      HeldAt held;
      w.world.contactPairTest(&lower, &upper, held);
      tipping += !(held.leastReach() > 0);
    }
    EXPECT_EQ(tipping, 0) << flat.name << ": of " << kPoses << " poses, seed " << kSeed;
  }
}

INSTANTIATE_TEST_SUITE_P(On, TiltedOverlap, testing::Values(Below::twin, Below::box, Below::hull, Below::mesh));

TEST(FlatPieces, StandInPilesOfSix) {
  constexpr unsigned kSeed = 3;
  constexpr int kPieces = 6, kSeconds = 5;
  constexpr btScalar kGap = btScalar(0.002);  // each is set down so far above the one below
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> turn(-1, 1);
  for (const Flat& flat : flatPieces()) {
    const auto shape = shapeOf(flat.solid);
    BulletWorld<> w;
    w.addGround();
    std::vector<btRigidBody*> pile;
    for (int i = 0; i < kPieces; ++i) {
      const btQuaternion turned(btVector3(0, 0, 1), btScalar(turn(random)));
      const btTransform mesh(turned, btVector3(0, 0, kGap * btScalar(i + 1) + btScalar(kThick) * btScalar(i)));
      const btTransform body = centred(*shape, mesh);
      pile.push_back(&w.add(shape, 1, body.getOrigin(), body.getRotation()));
      pile.back()->setFriction(btScalar(0.3));
    }
    w.step(60 * kSeconds);
    int fallen = 0;
    for (int i = 1; i < kPieces; ++i)
      fallen += double(pile[std::size_t(i)]->getWorldTransform().getOrigin().z()) < 0.8 * kThick * i;
    EXPECT_EQ(fallen, 0) << flat.name << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace cairn::test::tilted_overlap_test
