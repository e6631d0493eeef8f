// SPDX-License-Identifier: Zlib
// Where meshes have few triangles, these say what touches: it must be what is true of the meshes.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "bullet_world.h"
#include "cairn/core/tree_pair_traversal.h"
#include "faces/few_faces.h"
#include "placement/triangle.h"
#include "random_tree.h"
#include "test_solids.h"
#include "test_trees.h"

namespace cairn::test::few_faces_test {
namespace {

using bullet::Contact;
using bullet::FewFaces;
using bullet::PlacedTree;
using bullet::Triangle;

constexpr unsigned kSeed = 7;
constexpr float kReach = 0.004F;
// Bodies of a metre or two in floats: products and sums of a few lengths, each rounded to 2^-24 of them.
constexpr float kRounding = 64 * 0x1p-24F;

// Where a side gives way by 2^-20 of lengths of up to two metres, a triangle may be looked at beyond its border; the
// steepest that counts rises a hundred times as far.
constexpr float kBeyondBorder = 2 * 100 * 0x1p-20F;

Pose at(const Vec3d& place, const Mat3d& rotation = Mat3d()) {
  return {rotation, place, 1};
}

std::vector<Triangle> meshOf(const PlacedTree& placed) {
  std::vector<Triangle> mesh;
  const auto vertices = placed.tree().vertices();
  for (const auto& t : placed.tree().triangles())
    mesh.push_back(
        {placed.toPair() * vertices[t[0]], placed.toPair() * vertices[t[1]], placed.toPair() * vertices[t[2]]});
  return mesh;
}

float distanceTo(const std::vector<Triangle>& mesh, const Vec3& p) {
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : mesh) least = std::min(least, distance(p, nearestOnTriangle(t, p).point));
  return least;
}

// Of meshes that do not cross.
float distanceOf(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : a)
    for (const Triangle& u : b) {
      const bullet::NearestPoints nearest = nearestOfTriangles(t, u);
      least = std::min(least, distance(nearest.onFirst, nearest.onSecond));
    }
  return least;
}

struct Two {
  std::shared_ptr<const SphereTree> treeA, treeB;
  PlacedTree a, b;
  TreePairTraversal traversal;
  FewFaces few;
  std::vector<Contact> contacts;

  Two(const Solid& solidA, const Solid& solidB) : treeA(plainTree(solidA)), treeB(plainTree(solidB)) {
    few.start(*treeA, *treeB);
  }

  std::optional<float> ask(const Pose& poseA, const Pose& poseB) {
    a = PlacedTree(*treeA, poseA);
    b = PlacedTree(*treeB, poseB);
    traversal.start(*treeA, *treeB, poseA, poseB, kReach);
    few.start(*treeA, *treeB);
    Budget budget = Budget::unlimited();
    traversal.refine(budget);
    contacts.clear();
    return few.append(a, b, 0, kReach, traversal.leafPairs(), budget, contacts);
  }
};

Solid randomCuboid(std::mt19937_64& engine) {
  return cuboid({uniform(engine, 0.3, 1), uniform(engine, 0.3, 1), uniform(engine, 0.3, 1)}, 1);
}

TEST(FewFaces, BetweenCuboidsSayWhatIsTrueOfTheMeshes) {
  std::mt19937_64 engine(kSeed);
  int touching = 0, apart = 0, unanswered = 0;
  for (int i = 0; i < 60; ++i) {
    Two two(randomCuboid(engine), randomCuboid(engine));
    const Mat3d turnA = randomRotation(engine), turnB = randomRotation(engine);
    const Vec3d away = normalized(randomPoint(engine) + Vec3d(0, 0, 1e-3));
    // Nearer and nearer until they would cross: contacts are asked for all the way.
    for (double way = 2; way > 0; way -= 0.002) {
      const std::optional<float> gap = two.ask(at(away * way, turnA), at({}, turnB));
      const std::vector<Triangle> meshA = meshOf(two.a), meshB = meshOf(two.b);
      if (!two.traversal.leafPairs().empty()) {
        const float truth = distanceOf(meshA, meshB);
        unanswered += gap ? 0 : 1;
        if (gap && two.contacts.empty()) {
          ++apart;
          ASSERT_GE(truth, *gap - kRounding) << "seed " << kSeed << ", case " << i;
        }
        for (const Contact& c : two.contacts) {
          ASSERT_LT(c.gap, kReach);
          if (c.gap > kBeyondBorder) ASSERT_LE(truth, c.gap + kBeyondBorder) << "seed " << kSeed << ", case " << i;
          ASSERT_LT(distanceTo(meshA, c.onTree()), kBeyondBorder) << "seed " << kSeed << ", case " << i;
          ASSERT_LT(distanceTo(meshB, c.onCounterpart()), kBeyondBorder) << "seed " << kSeed << ", case " << i;
        }
      }
      if (two.contacts.empty()) continue;
      ++touching;
      if (two.contacts.front().gap < 0) break;
    }
  }
  EXPECT_GE(touching, 60);
  EXPECT_GT(apart, 1000);
  EXPECT_LT(unanswered, (touching + apart) / 100) << "leaf pairs have to be asked too often";
}

bool hasCorner(const std::vector<Contact>& contacts, double x, double y) {
  for (const Contact& c : contacts)
    if (std::abs(c.position.x - float(x)) < kRounding && std::abs(c.position.y - float(y)) < kRounding) return true;
  return false;
}

TEST(FewFaces, OfACubeOnACubeAreTheCornersTheyHaveInCommon) {
  Two two(cuboid({1, 1, 1}, 1), cuboid({1, 1, 1}, 1));
  ASSERT_TRUE(two.ask(at({0.3, 0.2, 1.001}), at({})));
  for (const double x : {-0.2, 0.5})
    for (const double y : {-0.3, 0.5}) EXPECT_TRUE(hasCorner(two.contacts, x, y)) << x << ", " << y;
  for (const Contact& c : two.contacts) {
    EXPECT_NEAR(c.gap, 0.001F, kRounding);
    EXPECT_EQ(c.normal, Vec3(0, 0, 1));
  }
}

// Deeper than they were, and beside each other less deep: what was remembered yields only where it must.
TEST(FewFaces, KeepTheirDirectionUntilAnotherIsMuchShallower) {
  Two two(cuboid({1, 1, 1}, 1), cuboid({1, 1, 1}, 1));
  ASSERT_TRUE(two.ask(at({0.995, 0, 0.999}), at({})));
  ASSERT_FALSE(two.contacts.empty());
  EXPECT_EQ(two.contacts.front().normal, Vec3(0, 0, 1));
  ASSERT_TRUE(two.ask(at({0.998, 0, 0.997}), at({})));
  EXPECT_EQ(two.contacts.front().normal, Vec3(0, 0, 1)) << "0.003 down, 0.002 aside";
  ASSERT_TRUE(two.ask(at({0.998, 0, 0.98}), at({})));
  EXPECT_EQ(two.contacts.front().normal, Vec3(1, 0, 0)) << "0.02 down, 0.002 aside";
}

TEST(FewFaces, OfTwoFeetOnAFloorAreTheFeetsCorners) {
  Two two(twoCuboids({0.2, 0.4, 0.3}, {1, 0, 0}, 1), cuboid({3, 3, 1}, 1));
  const Pose onFloor = at({0, 0, 0.6505});
  EXPECT_FALSE(two.ask(onFloor, at({}))) << "nothing is known of bodies that are not convex";
  two.few.learn(two.a, two.b, std::vector{Vec3(0, 0, 1)});
  ASSERT_TRUE(two.ask(onFloor, at({})));
  float lowest = std::numeric_limits<float>::infinity();
  for (const Vec3& v : two.treeA->vertices()) lowest = std::min(lowest, (two.a.toPair() * v).z);
  int corners = 0;
  for (const Vec3& v : two.treeA->vertices()) {
    const Vec3 placed = two.a.toPair() * v;
    if (placed.z > lowest + kRounding) continue;
    EXPECT_TRUE(hasCorner(two.contacts, placed.x, placed.y));
    ++corners;
  }
  EXPECT_EQ(corners, 8);
}

// On the low block, and into the side of the high one, which nobody knows of.
TEST(FewFaces, DoNotAnswerWhereSomethingElseIsTouched) {
  Two two(cuboid({0.4, 0.4, 0.4}, 1), twoCuboids({0.5, 0.5, 0.5}, {0.5, 0, 0.3}, 1));
  const auto vertices = two.treeB->vertices();
  Vec3 low(0, 0, 9);
  float side = -9;
  for (const Vec3& v : vertices) low.z = std::min(low.z, v.z);
  for (const Vec3& v : vertices) side = std::max(side, v.x);
  const double top = double(low.z) + 0.5, wall = double(side) - 0.5;
  const auto beside = [&](double by) { return at({wall - 0.2 - by, 0, top + 0.2}); };
  two.ask(beside(0.05), at({}));
  two.few.learn(two.a, two.b, std::vector{Vec3(0, 0, 1)});
  EXPECT_TRUE(two.ask(beside(0.05), at({})));
  EXPECT_FALSE(two.contacts.empty());
  EXPECT_FALSE(two.ask(beside(-0.01), at({})));
  EXPECT_TRUE(two.contacts.empty());
}

TEST(FewFaces, MeshesOfManyTrianglesAreLeftToTheLeaves) {
  Two two(cuboid({1, 1, 1}, 3), cuboid({1, 1, 1}, 1));
  EXPECT_FALSE(two.ask(at({0, 0, 1}), at({})));
}

TEST(FewFaces, OnAPlaneAreTheLowestVertices) {
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 100; ++i) {
    BulletWorld<> w;
    w.addGround();
    btMatrix3x3 turn;
    const Mat3d r = randomRotation(engine);
    for (int k = 0; k < 3; ++k) turn[k].setValue(btScalar(r.rows[k].x), btScalar(r.rows[k].y), btScalar(r.rows[k].z));
    btQuaternion rotation;
    turn.getRotation(rotation);
    const auto shape = treeShape(plainTree(randomCuboid(engine)));
    btRigidBody& body = w.add(shape, 1, btVector3(0, 0, 0), rotation);
    btVector3 lowest(0, 0, 100);
    for (const Vec3& v : shape->tree().vertices()) {
      const btVector3 placed = body.getWorldTransform() * shape->bodyFromTree() * btVector3(v.x, v.y, v.z);
      if (placed.z() < lowest.z()) lowest = placed;
    }
    btTransform pose = body.getWorldTransform();
    pose.getOrigin().setZ(btScalar(0.001) - lowest.z());
    body.setWorldTransform(pose);
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(0);
    ASSERT_GE(m.getNumContacts(), 1);
    btScalar least = 1;
    for (int k = 0; k < m.getNumContacts(); ++k) least = std::min(least, m.getContactPoint(k).getDistance());
    EXPECT_NEAR(least, 0.001, kRounding) << "seed " << kSeed << ", case " << i;
  }
}

// Less than a thousandth apart, a corner beside a corner: what leaves say of that had been 0.13 deep.
TEST(FewFaces, WhatIsJustApartIsNotDeep) {
  BulletWorld<> w;
  w.add(treeShape(plainTree(cuboid({1, 1, 1}, 1))), 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(cuboid({0.1, 0.1, 2}, 1))), 1,
        btVector3(btScalar(-0.153226241), btScalar(1.29538965), btScalar(0.473397017)),
        btQuaternion(btScalar(-0.573605716), btScalar(0.43209523), btScalar(0.105297394), btScalar(0.687882781)));
  w.world.performDiscreteCollisionDetection();
  for (int m = 0; m < w.dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *w.dispatcher.getManifoldByIndexInternal(m);
    for (int i = 0; i < manifold.getNumContacts(); ++i)
      EXPECT_GT(manifold.getContactPoint(i).getDistance(), btScalar(-0.001));
  }
}

}  // namespace
}  // namespace cairn::test::few_faces_test
