// SPDX-License-Identifier: Zlib
// Past the leaves: contacts lie on the meshes themselves, as far as the budget goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "bullet_world.h"
#include "kernel/contact_tuning.h"
#include "placement/bullet_math.h"
#include "placement/triangle.h"
#include "random_tree.h"

namespace cairn::test::exact_contacts_test {
namespace {

using bullet::Finest;
using bullet::Triangle;

constexpr unsigned kSeed = 41;
// Sizes are about one, and a coordinate is rounded some ten times on its way into Bullet's manifold and back.
constexpr float kRounding = 1e-5F;
// Box diagonal of the smaller bodies, at most.
constexpr float kSize = 1.4F;

std::vector<Triangle> meshOf(const btCollisionObject& body) {
  const auto& shape = *bullet::asSphereTree(body.getCollisionShape());
  const btTransform place = body.getWorldTransform() * shape.bodyFromTree();
  std::vector<Triangle> mesh;
  for (const auto& t : shape.tree().triangles()) {
    const auto at = [&](std::size_t k) {
      return bullet::toVec3(place * bullet::toBullet(shape.tree().vertices()[t[k]] * float(shape.scale())));
    };
    mesh.push_back({at(0), at(1), at(2)});
  }
  return mesh;
}

float distanceTo(const std::vector<Triangle>& mesh, const btVector3& point) {
  const Vec3 p = bullet::toVec3(point);
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : mesh) least = std::min(least, distance(p, nearestOnTriangle(t, p).point));
  return least;
}

btQuaternion randomTurn(std::mt19937_64& engine) {
  const Vec3d axis = normalized(randomPoint(engine) + Vec3d(0, 0, 1e-3));
  return {btVector3(btScalar(axis.x), btScalar(axis.y), btScalar(axis.z)), btScalar(uniform(engine, 0, 3))};
}

// Greatest distance of a contact point from the mesh it is said to be on, beyond what contacts may be beside the
// features they touch: what overlaps by its depth, what does not by a fiftieth of the contact distance.
float strayOf(BulletWorld<>& w, const btRigidBody& lower, const btRigidBody& upper) {
  const std::vector<Triangle> ofLower = meshOf(lower), ofUpper = meshOf(upper);
  float worst = 0;
  w.world.performDiscreteCollisionDetection();
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
    const bool lowerIsA = m.getBody0() == &lower;
    for (int k = 0; k < m.getNumContacts(); ++k) {
      const btManifoldPoint& p = m.getContactPoint(k);
      const btVector3& onLower = lowerIsA ? p.getPositionWorldOnA() : p.getPositionWorldOnB();
      const btVector3& onUpper = lowerIsA ? p.getPositionWorldOnB() : p.getPositionWorldOnA();
      const auto beside =
          std::max(float(-p.getDistance()), bullet::tuning::kBeside * bullet::tuning::kContactDistance * kSize);
      worst = std::max({worst, distanceTo(ofLower, onLower) - beside, distanceTo(ofUpper, onUpper) - beside});
    }
  }
  return worst;
}

// Two coarse trees that just touch: eight triangles a leaf, so that leaves say little.
struct Touching {
  BulletWorld<> w;
  btRigidBody *lower, *upper;

  Touching(std::mt19937_64& engine, Finest finest) {
    w.dispatcher.setFinest(finest);
    lower = &w.add(treeShape(plainTree(ball(0.5, 8), 8)), 0, btVector3(0, 0, 0), randomTurn(engine));
    upper = &w.add(treeShape(plainTree(ball(0.4, 6), 8)), 1, btVector3(0, 0, btScalar(0.88)), randomTurn(engine));
  }
};

// By the signs of volumes, in double.
bool pierces(const Vec3& from, const Vec3& to, const Triangle& t) {
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a)), Vec3d(d) - Vec3d(a));
  };
  if ((volume(t.a, t.b, t.c, from) > 0) == (volume(t.a, t.b, t.c, to) > 0)) return false;
  const bool first = volume(from, to, t.a, t.b) > 0;
  return (volume(from, to, t.b, t.c) > 0) == first && (volume(from, to, t.c, t.a) > 0) == first;
}

bool edgesPierce(const Triangle& e, const Triangle& t) {
  return pierces(e.a, e.b, t) || pierces(e.b, e.c, t) || pierces(e.c, e.a, t);
}

bool boxesMeet(const Triangle& t, const Triangle& u) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({t.a[axis], t.b[axis], t.c[axis]});
    const auto [lower, upper] = std::minmax({u.a[axis], u.b[axis], u.c[axis]});
    if (low > upper || lower > high) return false;
  }
  return true;
}

// The same with support points that leave out three tenths of each region all around.
std::shared_ptr<const SphereTree> withPoorPoints(const SphereTree& tree) {
  SphereTreeData data = tree.data();
  for (const NodeData& node : data.nodes)
    for (Vec3& point : std::span(data.supportPoints).subspan(node.firstSupport, node.supportCount))
      point = node.center + (point - node.center) * 0.7F;
  return std::make_shared<const SphereTree>(SphereTree::create(std::move(data)).value());
}

// Two rings, one above the other, turned at random.
struct Rings {
  BulletWorld<> w;
  btRigidBody *lower, *upper;

  explicit Rings(std::mt19937_64& engine) {
    const auto shape = treeShape(withPoorPoints(*plainTree(torus(0.3, 0.12, 10), 8)));
    lower = &w.add(shape, 0, btVector3(0, 0, 0), randomTurn(engine));
    upper = &w.add(shape, 1, btVector3(0, 0, 2), randomTurn(engine));
  }

  void moveTo(btScalar height) { upper->getWorldTransform().getOrigin().setZ(height); }

  bool cross() const {
    const std::vector<Triangle> meshes[] = {meshOf(*lower), meshOf(*upper)};
    return std::ranges::any_of(meshes[0], [&](const Triangle& t) {
      return std::ranges::any_of(
          meshes[1], [&](const Triangle& u) { return boxesMeet(t, u) && (edgesPierce(t, u) || edgesPierce(u, t)); });
    });
  }

  // Up to which the upper one can be lifted before it is free.
  btScalar meetingHeight() {
    btScalar meets = 0, free = btScalar(0.9);
    for (btScalar step = btScalar(0.02); step > btScalar(1e-6); step /= 20) {
      for (btScalar height = free; height > meets; height -= step) {
        moveTo(height);
        if (!cross()) continue;
        meets = height;
        free = height + step;
        break;
      }
    }
    return meets;
  }

  std::uint32_t contacts(Finest finest) {
    w.dispatcher.setFinest(finest);
    w.world.performDiscreteCollisionDetection();
    return w.dispatcher.lastStep().contacts;
  }
};

TEST(ExactContacts, LieOnBothMeshes) {
  std::mt19937_64 engine(kSeed);
  float worstOfLeaves = 0;
  std::uint32_t contacts = 0;
  constexpr int kTrials = 40;
  int exactTrials = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::mt19937_64 start = engine;
    Touching exact(engine, Finest::triangles);
    const float stray = strayOf(exact.w, *exact.lower, *exact.upper);
    const auto& step = exact.w.dispatcher.lastStep();
    contacts += step.contacts;
    const bool isExact = step.contacts > 0 && step.exactContacts == step.contacts;
    exactTrials += isExact ? 1 : 0;
    if (isExact) EXPECT_LT(stray, kRounding) << "seed " << kSeed << ", trial " << trial;
    EXPECT_GE(10 * step.exactContacts, 9 * step.contacts) << "seed " << kSeed << ", trial " << trial;
    engine = start;
    Touching leaves(engine, Finest::leaves);
    worstOfLeaves = std::max(worstOfLeaves, strayOf(leaves.w, *leaves.lower, *leaves.upper));
    EXPECT_EQ(leaves.w.dispatcher.lastStep().exactContacts, 0U);
    if (isExact)
      EXPECT_LT(2 * step.worstErrorFraction, leaves.w.dispatcher.lastStep().worstErrorFraction)
          << "points on both meshes are as far apart as they are deep, spheres as they stick out";
  }
  EXPECT_GT(contacts, 40U);
  EXPECT_EQ(exactTrials, kTrials) << "contacts of leaves among those of meshes";
  EXPECT_GT(worstOfLeaves, 100 * kRounding) << "leaves are as good: the test shows nothing";
}

// Thousands of leaf pairs touch or nearly so in one cluster; the triangles are a little farther apart than they all.
TEST(ExactContacts, OfABallInItsSocketAreAllToldBetter) {
  BulletWorld<> w;
  w.dispatcher.setFinest(Finest::triangles);
  w.add(treeShape(plainTree(bowl(0.7, 0.5, 64), 2)), 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(ball(0.497, 24), 2)), 1, btVector3(0, 0, 0));
  w.world.performDiscreteCollisionDetection();
  const auto& step = w.dispatcher.lastStep();
  EXPECT_GT(step.contacts, 0U);
  EXPECT_EQ(step.exactContacts, step.contacts);
}

TEST(ExactContacts, AreAsManyAsTheBudgetAllows) {
  std::uint32_t before = 0;
  for (const std::int64_t operations : {0, 400, 1000, 2000, 20000}) {
    std::mt19937_64 engine(kSeed);
    Touching pair(engine, Finest::triangles);
    ASSERT_TRUE(pair.w.dispatcher.setBudget({operations, {}}).ok());
    pair.w.world.performDiscreteCollisionDetection();
    const auto& step = pair.w.dispatcher.lastStep();
    EXPECT_GE(step.exactContacts, before) << operations;
    before = step.exactContacts;
    if (operations == 0) {
      EXPECT_EQ(step.exactContacts, 0U);
    }
    // Holding back is for measuring leaves alone: see Budget_Operations.
    EXPECT_LE(step.operations, std::uint64_t(operations) + 64U * 5U + 32U * 5U + 129U * 3U) << operations;
  }
  EXPECT_GT(before, 0U);
}

// With triangles past the leaves nothing that overlaps is left out, though the leaves say nothing of it.
class Silence : public testing::TestWithParam<btScalar> {};

TEST_P(Silence, IsOfMeshesThatDoNotCross) {
  std::mt19937_64 engine(kSeed);
  int silentLeaves = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Rings rings(engine);
    rings.moveTo(rings.meetingHeight() - GetParam());
    ASSERT_TRUE(rings.cross()) << "seed " << kSeed << ", trial " << trial;
    silentLeaves += rings.contacts(Finest::leaves) == 0 ? 1 : 0;
    EXPECT_GT(rings.contacts(Finest::triangles), 0U) << "seed " << kSeed << ", trial " << trial;
  }
  EXPECT_GT(silentLeaves, 0) << "leaves tell of all: the test shows nothing";
}

// Answers of leaves or triangles along the way do not show: nothing comes and goes while the bodies lie still.
TEST_P(Silence, IsNotBrokenAnewInEveryStep) {
  std::mt19937_64 engine(kSeed);
  static int ends = 0;
  gContactEndedCallback = [](btPersistentManifold* const&) { ++ends; };
  for (int trial = 0; trial < 30; ++trial) {
    Rings rings(engine);
    rings.moveTo(rings.meetingHeight() - GetParam());
    ends = 0;
    for (int step = 0; step < 10; ++step) ASSERT_GT(rings.contacts(Finest::triangles), 0U);
    EXPECT_EQ(ends, 0) << "seed " << kSeed << ", trial " << trial;
  }
  gContactEndedCallback = nullptr;
}

// Exact ones lie on both meshes, and what is only known to touch is not told to overlap.
TEST_P(Silence, IsBrokenByWhatIsTrue) {
  std::mt19937_64 engine(kSeed);
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Rings rings(engine);
    rings.moveTo(rings.meetingHeight() - GetParam());
    const std::uint32_t contacts = rings.contacts(Finest::triangles);
    if (rings.w.dispatcher.lastStep().exactContacts == contacts) {
      EXPECT_LT(strayOf(rings.w, *rings.lower, *rings.upper), kRounding) << "seed " << kSeed << ", trial " << trial;
      continue;
    }
    ++touching;
    for (int i = 0; i < rings.w.dispatcher.getNumManifolds(); ++i)
      for (int k = 0; k < rings.w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts(); ++k)
        EXPECT_GE(rings.w.dispatcher.getManifoldByIndexInternal(i)->getContactPoint(k).getDistance(), -10 * GetParam());
  }
  EXPECT_LT(touching, 20);
}

INSTANTIATE_TEST_SUITE_P(Depths, Silence, testing::Values(btScalar(1e-4), btScalar(1e-3)));

// Deep in each other few triangles face each other: how deep is told by the leaves.
TEST(ExactContacts, DoNotKeepBodiesInEachOther) {
  constexpr double kRadius = 0.5;
  const auto tree = plainTree(ball(kRadius, 5), 4);
  for (const double apart : {0.05, 0.2, 0.4, 0.7}) {
    BulletWorld<> w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.dispatcher.setFinest(Finest::triangles);
    const btRigidBody& one = w.add(treeShape(tree), 1, btVector3(0, 0, 0));
    const btRigidBody& other = w.add(treeShape(tree), 1, btVector3(btScalar(apart), 0, 0));
    w.step(300);
    const btVector3 between = other.getWorldTransform().getOrigin() - one.getWorldTransform().getOrigin();
    EXPECT_GT(between.length(), 1.8 * kRadius) << apart << " apart";
  }
}

TEST(ExactContacts, SayNothingOfWhatIsApart) {
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 20; ++trial) {
    Rings rings(engine);
    rings.moveTo(rings.meetingHeight() + btScalar(0.02));
    ASSERT_FALSE(rings.cross());
    EXPECT_EQ(rings.contacts(Finest::triangles), 0U) << "seed " << kSeed << ", trial " << trial;
  }
}

// A flat face on a flat face touches with its corners, and does not float on tilted lines of centres.
TEST(ExactContacts, OfACubeOnItsTwinStandOnItsFace) {
  BulletWorld<> w;
  w.dispatcher.setFinest(Finest::triangles);
  const auto cube = plainTree(cuboid({1, 1, 1}, 3), 6);
  w.add(treeShape(cube), 0, btVector3(0, 0, 0));
  btRigidBody& upper = w.add(treeShape(cube), 1, btVector3(btScalar(0.03), btScalar(-0.02), btScalar(1.002)),
                             btQuaternion(btVector3(0, 0, 1), btScalar(0.2)));
  upper.setActivationState(DISABLE_DEACTIVATION);
  w.step(240);
  const btVector3& at = upper.getWorldTransform().getOrigin();
  EXPECT_NEAR(at.z(), 1, 0.004) << "the speculative distance is 0.2 % of 1.73";
  EXPECT_LT(std::abs(at.x() - btScalar(0.03)) + std::abs(at.y() + btScalar(0.02)), 0.02) << "wandered";
  const auto& step = w.dispatcher.lastStep();
  EXPECT_GE(step.contacts, 4U);
  EXPECT_EQ(step.exactContacts, step.contacts);
}

// The answer for a plane to a query that looks farther than contacts.
TEST(ExactContacts, OnAPlaneAreTheLowestCorners) {
  struct Deepest : btCollisionWorld::ContactResultCallback {
    btScalar separation = BT_LARGE_FLOAT;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      separation = std::min(separation, point.getDistance());
      return 0;
    }
  };
  std::mt19937_64 engine(kSeed);
  for (int trial = 0; trial < 40; ++trial) {
    BulletWorld<> w;
    btRigidBody& ground = w.addGround();
    const Vec3d axis = normalized(randomPoint(engine) + Vec3d(0, 0, 1e-3));
    btRigidBody& body = w.add(
        treeShape(plainTree(torus(0.3, 0.12, 12), 8)), 1, btVector3(0, 0, 5),
        btQuaternion(btVector3(btScalar(axis.x), btScalar(axis.y), btScalar(axis.z)), btScalar(uniform(engine, 0, 3))));
    float lowest = std::numeric_limits<float>::infinity();
    for (const Triangle& t : meshOf(body)) lowest = std::min({lowest, t.a.z, t.b.z, t.c.z});
    const btScalar sunk = btScalar(uniform(engine, -0.1, 0.05));
    body.getWorldTransform().getOrigin().setZ(5 - btScalar(lowest) - sunk);
    Deepest deepest;
    deepest.m_closestDistanceThreshold = btScalar(0.2);
    w.world.contactPairTest(&body, &ground, deepest);
    EXPECT_NEAR(deepest.separation, -sunk, kRounding) << "seed " << kSeed << ", trial " << trial;
  }
}

// All four, however they are rounded: a body that stands on one of them rocks. A margin counts once.
TEST(ExactContacts, OfAFaceOnAPlaneAreItsCorners) {
  for (const btScalar margin : {btScalar(0), btScalar(0.02)}) {
    BulletWorld<> w;
    w.dispatcher.setFinest(Finest::triangles);
    w.addGround();
    const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1), 2));
    shape->setMargin(margin);
    btRigidBody& body = w.add(shape, 1, btVector3(0, 0, btScalar(0.501) + margin));
    w.world.performDiscreteCollisionDetection();
    ASSERT_EQ(w.dispatcher.getNumManifolds(), 1);
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(0);
    ASSERT_EQ(m.getNumContacts(), 4) << margin;
    for (int k = 0; k < m.getNumContacts(); ++k) {
      const btManifoldPoint& p = m.getContactPoint(k);
      EXPECT_NEAR(p.getDistance(), 0.001, kRounding) << margin;
      EXPECT_NEAR(std::abs(p.getPositionWorldOnA().x()), 0.5, kRounding);
      EXPECT_NEAR(std::abs(p.getPositionWorldOnA().y()), 0.5, kRounding);
    }
    w.step(600);
    EXPECT_FALSE(body.isActive()) << margin;
  }
}

}  // namespace
}  // namespace cairn::test::exact_contacts_test
