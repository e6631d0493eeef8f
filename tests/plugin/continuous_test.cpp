// SPDX-License-Identifier: Zlib
// Continuous collision: what moves farther than its own size within a step is stopped by what is in its way, and by
// nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <utility>

#include "distance_fields.h"
#include "front_ends.h"
#include "shots.h"
#include "triangle_grounds.h"

namespace cairn::test::continuous_test {
namespace {

enum class Wall { box, hull, mesh, tree, field, plane };

std::shared_ptr<btCollisionShape> wallShape(Wall wall) {
  switch (wall) {
    case Wall::box:
      return std::make_shared<btBoxShape>(btVector3(kHalfWidth, kHalfWidth, kHalfThickness));
    case Wall::hull: {
      auto hull = std::make_shared<btConvexHullShape>();
      for (int corner = 0; corner < 8; ++corner)
        hull->addPoint(btVector3(corner & 1 ? kHalfWidth : -kHalfWidth, corner & 2 ? kHalfWidth : -kHalfWidth,
                                 corner & 4 ? kHalfThickness : -kHalfThickness));
      hull->setMargin(0);
      return hull;
    }
    case Wall::mesh: {
      static btTriangleMesh mesh;
      if (mesh.getNumTriangles() == 0) {
        const btScalar w = kHalfWidth;
        mesh.addTriangle(btVector3(-w, -w, 0), btVector3(w, -w, 0), btVector3(w, w, 0));
        mesh.addTriangle(btVector3(-w, -w, 0), btVector3(w, w, 0), btVector3(-w, w, 0));
      }
      return std::make_shared<btBvhTriangleMeshShape>(&mesh, true);
    }
    case Wall::tree: {
      const double w = 2 * double(kHalfWidth);
      static const std::shared_ptr<const SphereTree> slab = plainTree(cuboid({w, w, 2 * double(kHalfThickness)}, 8));
      return treeShape(slab);
    }
    case Wall::field: {
      const double w = double(kHalfWidth);
      static const auto field = fieldShape({{-w - 0.5, -w - 0.5, -0.5}, {w + 0.5, w + 0.5, 0.5}, {18, 18, 10}},
                                           boxDistance({w, w, double(kHalfThickness)}));
      return field;
    }
    case Wall::plane:
      break;
  }
  return std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
}

// The stock sphere beside: about as large, at the same places and speeds, and Bullet's own motion clamping.
btRigidBody& shootSphere(BulletWorld<>& w, const Shot& shot, bool isContinuous) {
  constexpr btScalar kRadius = btScalar(0.4);
  btRigidBody& body = w.add(std::make_shared<btSphereShape>(kRadius), 1, shot.from, shot.rotation);
  body.setLinearVelocity(shot.velocity);
  body.setAngularVelocity(shot.spin);
  body.setDamping(0, 0);
  if (!isContinuous) return body;
  body.setCcdMotionThreshold(btScalar(0.05));
  body.setCcdSweptSphereRadius(kRadius / 2);
  return body;
}

bool isOursAlone(Wall wall) {
  return wall == Wall::tree || wall == Wall::field;
}

class Shots : public testing::TestWithParam<Wall> {
 protected:
  // Against the wall as Bullet has it: a tree's is a box, and so is a field's, which Bullet does not look ahead for.
  static int spheresThrough(int count, bool isContinuous) {
    std::mt19937 random(kSeed);
    int passed = 0;
    for (int i = 0; i < count; ++i) {
      BulletWorld<> w;
      w.world.setGravity(btVector3(0, 0, 0));
      w.add(wallShape(isOursAlone(GetParam()) ? Wall::box : GetParam()), 0, btVector3(0, 0, 0));
      passed += passesThrough(w, shootSphere(w, randomShot(random), isContinuous), GetParam() == Wall::plane) ? 1 : 0;
    }
    return passed;
  }
  int through(int count, bool isContinuous, btScalar restitution) {
    std::mt19937 random(kSeed);
    int passed = 0;
    for (int i = 0; i < count; ++i) {
      BulletWorld<> w;
      w.world.setGravity(btVector3(0, 0, 0));
      w.add(wallShape(GetParam()), 0, btVector3(0, 0, 0)).setRestitution(1);
      btRigidBody& body = shoot(w, randomShot(random), bullet(i), isContinuous);
      body.setRestitution(restitution);
      const bool passes = passesThrough(w, body, GetParam() == Wall::plane);
      if (passes && isContinuous) {
        const btVector3& p = body.getWorldTransform().getOrigin();
        std::cout << "shot " << i << " ends at " << p.x() << " " << p.y() << " " << p.z() << "\n";
      }
      passed += passes ? 1 : 0;
    }
    return passed;
  }
};

// A slab's leaves are fifty times as wide as it is thick, and a field's plate has two sides within one cell.
TEST_P(Shots, NoneOfAThousandGoesThrough) {
  const int ours = through(1000, true, 0), spheres = spheresThrough(1000, true);
  std::cout << "of 1000 shots " << ours << " through; of Bullet's spheres " << spheres
            << ", without continuous collision " << spheresThrough(1000, false) << "\n";
  EXPECT_EQ(ours, 0) << "seed " << kSeed;
}

TEST_P(Shots, NoneOfThoseThatBounceGoesThrough) {
  EXPECT_EQ(through(200, true, btScalar(0.6)), 0) << "seed " << kSeed;
}

// Without it most do, or this would show nothing.
TEST_P(Shots, MostGoThroughWhenItIsOff) {
  if (GetParam() == Wall::plane) return;  // has no other side
  EXPECT_GT(through(100, false, 0), 30);
}

// As it always was: who does not ask for it gets bodies as they are.
TEST(Continuous, IsOffUntilItIsAskedFor) {
  BulletWorld<> w, v;
  for (BulletWorld<>* world : {&w, &v}) {
    world->addGround();
    world->add(treeShape(bullet(0)), 1, btVector3(0, 0, 1)).setLinearVelocity(btVector3(3, 0, -20));
  }
  w.world.getDispatchInfo().m_useContinuous = false;
  for (int i = 0; i < 60; ++i) {
    w.step();
    v.step();
    ASSERT_EQ(w.stateHash(), v.stateHash()) << "step " << i;
  }
}

// A body that flies by closely, fast and turning, keeps its speed: only obstacles in its way give contacts ahead.
TEST(Continuous, WhatFliesByIsNotTouched) {
  for (const btScalar speed : {btScalar(20), btScalar(100), btScalar(300)})
    for (int phase = 0; phase < 10; ++phase) {
      BulletWorld<> w;
      w.world.setGravity(btVector3(0, 0, 0));
      w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 0, btVector3(0, 0, 0));
      const Shot shot{btVector3(btScalar(-6) - btScalar(phase) * speed / 600, 0, btScalar(1.5)), btVector3(speed, 0, 0),
                      btVector3(0, 0, 5), btQuaternion(0, 0, 0)};
      btRigidBody& body = shoot(w, shot, bullet(0), true);
      w.step(40);
      EXPECT_EQ(body.getLinearVelocity(), shot.velocity) << speed << " m/s, phase " << phase;
    }
}

// A floor of cells half a metre wide, whose corners rise by up to so much.
std::shared_ptr<btCollisionShape> longFloor(btScalar bump) {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> part(0, 1);
  constexpr int kLong = 200, kWide = 16;
  constexpr btScalar kCell = btScalar(0.5);
  std::vector<btVector3> corners;
  for (int i = 0; i <= kLong; ++i)
    for (int j = 0; j <= kWide; ++j)
      corners.emplace_back(btScalar(i - 4) * kCell, (btScalar(j) - btScalar(7.9)) * kCell,
                           bump * btScalar(part(random)));
  std::vector<btVector3> triangles;
  for (int i = 0; i < kLong; ++i)
    for (int j = 0; j < kWide; ++j) {
      const auto at = [&](int di, int dj) { return corners[std::size_t((i + di) * (kWide + 1) + j + dj)]; };
      for (const btVector3& corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
        triangles.push_back(corner);
    }
  return meshOf(triangles);
}

// A body that slides fast over a floor of triangles is not caught by inner edges: as without looking ahead.
TEST(Continuous, WhatSlidesOverTrianglesIsNotCaughtByTheirEdges) {
  const std::shared_ptr<const SphereTree> trees[] = {plainTree(cuboid({1, 0.6, 0.3}, 4)),
                                                     plainTree(torus(0.35, 0.15, 16))};
  for (const btScalar bump : {btScalar(0), btScalar(0.002)})
    for (const btScalar threshold : {btScalar(0.1), btScalar(1e-6)})
      for (const auto& tree : trees) {
        BulletWorld<> w;
        w.add(longFloor(bump), 0, btVector3(0, 0, 0));
        btRigidBody& body = w.add(treeShape(tree), 1, btVector3(0, 0, btScalar(0.153)));
        body.setFriction(0);
        body.setDamping(0, 0);
        body.setCcdMotionThreshold(threshold);
        body.setLinearVelocity(btVector3(30, 0, 0));
        for (int i = 0; i < 180; ++i) {
          w.step();
          ASSERT_LT(body.getWorldTransform().getOrigin().z(), btScalar(0.17)) << "step " << i;
        }
        EXPECT_GT(body.getLinearVelocity().x(), btScalar(29.8)) << "bumps of " << bump << ", from " << threshold;
      }
}

// A ghost reports the bodies inside it, not those that will be.
TEST(Continuous, SensorsSeeWhatIsThere) {
  BulletWorld<> w;
  w.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& sensor = w.add(std::make_shared<btBoxShape>(btVector3(btScalar(0.5), 2, 2)), 0, btVector3(0, 0, 0));
  sensor.setCollisionFlags(sensor.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  btRigidBody& body = w.add(treeShape(bullet(2)), 1, btVector3(btScalar(-6.2), 0, 0));
  body.setDamping(0, 0);
  body.setLinearVelocity(btVector3(120, 0, 0));
  body.setCcdMotionThreshold(btScalar(0.05));
  for (int i = 0; i < 8; ++i) {
    const bool isInside = std::abs(body.getWorldTransform().getOrigin().x()) < btScalar(0.9);
    w.step();
    EXPECT_EQ(w.dispatcher.getNumManifolds() > 0 && w.dispatcher.getManifoldByIndexInternal(0)->getNumContacts() > 0,
              isInside)
        << "step " << i;
  }
}

// Bodies pressed together are not held at places of long ago: a heap rests as it does without looking ahead.
TEST(Continuous, AHeapOfWhatFellFastRests) {
  BulletWorld<> w;
  w.addGround().setRestitution(1);
  std::vector<btRigidBody*> bodies;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> aside(-0.05, 0.05);
  for (int i = 0; i < 24; ++i) {
    const btVector3 at(btScalar(aside(random)), btScalar(aside(random)), btScalar(0.6 + 0.3 * i));
    bodies.push_back(&w.add(treeShape(bullet(0)), 1, at));
    bodies.back()->setRestitution(btScalar(0.5));
    bodies.back()->setCcdMotionThreshold(btScalar(0.1));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
  }
  w.step(600);
  btScalar sum = 0;
  for (int i = 0; i < 60; ++i) {
    w.step();
    for (const btRigidBody* body : bodies) sum += body->getLinearVelocity().length();
  }
  EXPECT_LT(sum / btScalar(60 * bodies.size()), btScalar(0.05));
}

// A floor and two walls of one mesh, all met within a step.
TEST(Continuous, NothingLeavesACorner) {
  btTriangleMesh mesh;
  constexpr btScalar w = 10;
  for (int axis = 0; axis < 3; ++axis) {
    btVector3 one(0, 0, 0), two(0, 0, 0);
    one[(axis + 1) % 3] = w;
    two[(axis + 2) % 3] = w;
    mesh.addTriangle(btVector3(0, 0, 0), one, one + two);
    mesh.addTriangle(btVector3(0, 0, 0), one + two, two);
  }
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> part(0, 1);
  int outside = 0;
  for (int i = 0; i < 300; ++i) {
    BulletWorld<> w2;
    w2.world.setGravity(btVector3(0, 0, 0));
    w2.add(std::make_shared<btBvhTriangleMeshShape>(&mesh, true), 0, btVector3(0, 0, 0));
    Shot shot = randomShot(random);
    shot.from =
        btVector3(btScalar(1.2 + 3 * part(random)), btScalar(1.2 + 3 * part(random)), btScalar(1.2 + 3 * part(random)));
    const btVector3 aim(btScalar(part(random)), btScalar(part(random)), btScalar(part(random)));
    shot.velocity = (aim - shot.from).normalized() * btScalar(50 + 200 * part(random));
    const btRigidBody& body = shoot(w2, shot, bullet(i), true);
    w2.step(10);
    const btVector3& p = body.getWorldTransform().getOrigin();
    outside += p[p.minAxis()] < 0 ? 1 : 0;
  }
  EXPECT_EQ(outside, 0) << "seed " << kSeed;
}

btScalar gShift = 0;  // of what a callback tells of a point it is shown

bool shiftDistance(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*,
                   int, int) {
  point.m_distance1 += gShift;
  return false;
}

bool shiftPlace(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int, const btCollisionObjectWrapper*, int,
                int) {
  point.m_positionWorldOnB += point.m_normalWorldOnB * gShift;
  return false;
}

// Height of a cube that came down onto a floor, after two seconds, and the greatest after the first steps.
std::pair<btScalar, btScalar> fallOntoFloor(ContactAddedCallback callback, btScalar speed) {
  gContactAddedCallback = callback;
  BulletWorld<> w;
  w.add(std::make_shared<btBoxShape>(btVector3(9, 9, 1)), 0, btVector3(0, 0, -1));
  btRigidBody& body =
      w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, btScalar(0.501) + 2 * speed / 60));
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  body.setLinearVelocity(btVector3(0, 0, -speed));
  body.setCcdMotionThreshold(speed > 0 ? btScalar(0.05) : btScalar(0));
  body.setActivationState(DISABLE_DEACTIVATION);
  btScalar highest = 0;
  for (int i = 0; i < 120; ++i) {
    w.step();
    if (i > 5) highest = std::max(highest, body.getWorldTransform().getOrigin().z());
  }
  gContactAddedCallback = nullptr;
  return {body.getWorldTransform().getOrigin().z(), highest};
}

// Bullet's shapes have their points brought up to date after they were shown: what a callback did to the place in the
// world or the distance is undone. One ahead used to be taken for one that touches, and held the body in mid-air.
TEST(Continuous, WhatACallbackDoesToPlaceOrDistanceIsUndone) {
  for (const ContactAddedCallback callback : {&shiftDistance, &shiftPlace})
    for (const btScalar shift : {btScalar(-0.01), btScalar(0.01)})
      for (const btScalar speed : {btScalar(0), btScalar(30), btScalar(100)}) {
        const auto [plain, highestPlain] = fallOntoFloor(nullptr, speed);
        gShift = shift;
        const auto [end, highest] = fallOntoFloor(callback, speed);
        EXPECT_NEAR(end, plain, 1e-3) << speed << " m/s, shifted by " << shift;
        EXPECT_NEAR(highest, highestPlain, 1e-3) << speed << " m/s, shifted by " << shift;
      }
}

template <class FrontEndType>
class ContinuousEverywhere : public testing::Test {};
TYPED_TEST_SUITE(ContinuousEverywhere, EveryFrontEnd, FrontEndName);

// Fast bodies are looked after before any budget is asked, and first.
TYPED_TEST(ContinuousEverywhere, AShotIsStoppedOnAnyBudget) {
  for (const std::int64_t operations : {0, 100, 10000, 1000000}) {
    std::mt19937 random(kSeed);
    for (int i = 0; i < 30; ++i) {
      BulletWorld<TypeParam> w;
      w.world.setGravity(btVector3(0, 0, 0));
      w.add(wallShape(Wall::box), 0, btVector3(0, 0, 0));
      for (int other = 0; other < 4; ++other)
        w.add(treeShape(bullet(other)), 1, btVector3(btScalar(other - 2), btScalar(0.1), btScalar(0.4)));
      btRigidBody& body = shoot(w, randomShot(random), bullet(i), true);
      bullet::StepBudget budget;
      budget.operations = operations;
      ASSERT_TRUE(w.dispatcher.setBudget(budget));
      EXPECT_FALSE(passesThrough(w, body, false)) << operations << " operations, shot " << i;
    }
  }
}

std::string nameOf(const testing::TestParamInfo<Wall>& info) {
  constexpr const char* kNames[] = {"Box", "Hull", "Mesh", "Tree", "Field", "Plane"};
  return kNames[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(At, Shots,
                         testing::Values(Wall::box, Wall::hull, Wall::mesh, Wall::tree, Wall::field, Wall::plane),
                         nameOf);

}  // namespace
}  // namespace cairn::test::continuous_test
