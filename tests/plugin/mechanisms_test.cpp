// SPDX-License-Identifier: Zlib
// Bodies that move in or on another with a little play: marbles in a tube, cups in each other, gears, a nut on its
// bolt.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bullet_world.h"
#include "turned.h"

namespace cairn::test::mechanisms_test {
namespace {

constexpr double kG = 10;
constexpr double kStill = 0.02;  // m/s: what the pieces of `fits_test` that nobody moves may have

struct Bench {
  BulletWorld<> w;

  Bench() { w.world.setGravity(btVector3(0, 0, btScalar(-kG))); }
  btRigidBody& add(const Solid& solid, btScalar mass, btScalar friction, const btVector3& at,
                   const btQuaternion& turn = btQuaternion::getIdentity()) {
    btRigidBody& body = w.add(treeShape(plainTree(solid, 4)), mass, at, turn);
    body.setFriction(friction);
    body.setActivationState(DISABLE_DEACTIVATION);
    return body;
  }
};

Solid tube(double radius, double half) {
  const double corner = radius / std::cos(std::numbers::pi / 48);  // its flats are that far off
  return turnedAround({{corner, -half}, {1.5 * radius, -half}, {1.5 * radius, half}, {corner, half}}, 48);
}

// Trees or Bullet's balls, one and ten per cent narrower than their tube.
TEST(Mechanisms, MarblesFallThroughTheirTube) {
  for (const bool isTree : {true, false})
    for (const double play : {0.01, 0.1}) {
      Bench bench;
      const double radius = 0.2;
      bench.add(tube(radius * (1 + play), 1), 0, btScalar(0.3), btVector3(0, 0, 0));
      bench.add(cuboid({2, 2, 0.2}, 2), 0, btScalar(0.3), btVector3(0, 0, btScalar(-1.1)));
      std::vector<btRigidBody*> marbles;
      for (int i = 0; i < 4; ++i) {
        const btVector3 at(btScalar(0.001 * i), 0, btScalar(-0.6 + 0.6 * i));
        if (isTree)
          marbles.push_back(&bench.add(ball(radius, 10), 1, btScalar(0.3), at));
        else
          marbles.push_back(&bench.w.add(std::make_shared<btSphereShape>(btScalar(radius)), 1, at));
      }
      bench.w.step(300);
      for (std::size_t i = 0; i < marbles.size(); ++i) {
        // Beside each other they lie as low as the play lets them.
        const double lowest = std::sqrt(4 * radius * radius - 4 * play * play * radius * radius);
        EXPECT_LT(double(marbles[i]->getWorldTransform().getOrigin().z()), -1 + radius + 2 * radius * double(i) + 0.002)
            << "tree " << isTree << ", play " << play << ", marble " << i;
        EXPECT_GT(double(marbles[i]->getWorldTransform().getOrigin().z()),
                  -1 + radius + lowest * double(i) - 0.002 * double(i + 1))
            << "tree " << isTree << ", play " << play << ", marble " << i;
        EXPECT_LT(double(marbles[i]->getLinearVelocity().length()), kStill);
      }
    }
}

// With walls of a hundredth of their height.
TEST(Mechanisms, CupsStandInEachOther) {
  constexpr double kWall = 0.01;
  const Solid cup =
      turnedAround({{0, 0}, {0.3, 0}, {0.4, 0.6}, {0.4 - kWall, 0.6}, {0.3 - kWall, kWall}, {0, kWall}}, 48);
  // Walls lean by one in six: so far one stands above the other.
  const double apart = kWall * std::hypot(1, 6);
  for (int start = 0; start < 6; ++start) {
    Bench bench;
    bench.add(cuboid({4, 4, 0.2}, 2), 0, btScalar(0.3), btVector3(0, 0, btScalar(-0.1)));
    std::vector<btRigidBody*> cups;
    for (int i = 0; i < 4; ++i)
      cups.push_back(&bench.add(cup, btScalar(0.1), btScalar(0.3),
                                btVector3(btScalar(0.0008 * start * i), 0, btScalar(0.002 + 0.12 * i))));
    bench.w.step(360);
    double speed = 0;
    constexpr int kSteps = 120;
    for (int step = 0; step < kSteps; ++step) {
      bench.w.step();
      for (const btRigidBody* one : cups) speed += double(one->getLinearVelocity().length()) / (kSteps * 4);
    }
    EXPECT_LT(speed, kStill) << "start " << start;
    for (std::size_t i = 1; i < cups.size(); ++i) {
      const btVector3 &upper = cups[i]->getWorldTransform().getOrigin(),
                      &lower = cups[i - 1]->getWorldTransform().getOrigin();
      EXPECT_NEAR(double(upper.z() - lower.z()), apart, 0.15 * apart) << "start " << start << ", cup " << i;
    }
  }
}

Solid gear(int teeth) {
  Outline outline;
  for (int i = 0; i < teeth; ++i) {
    const double middle = 2 * std::numbers::pi * i / teeth, half = std::numbers::pi / teeth;
    const std::array<std::array<double, 2>, 4> corners{{{0.9, -0.55}, {1.1, -0.25}, {1.1, 0.25}, {0.9, 0.55}}};
    for (const auto& [radius, aside] : corners)
      outline.push_back({radius * std::cos(middle + half * aside), radius * std::sin(middle + half * aside)});
  }
  return extruded(outline, -0.1, 0.1);
}

TEST(Mechanisms, AGearTurnsTheOtherBackwards) {
  constexpr int kTeeth = 12;
  constexpr double kApart = 2.03;
  Bench bench;
  bench.w.world.setGravity(btVector3(0, 0, 0));
  btRigidBody& driver = bench.add(gear(kTeeth), 1, btScalar(0.3), btVector3(0, 0, 0));
  btRigidBody& driven = bench.add(gear(kTeeth), 1, btScalar(0.3), btVector3(btScalar(kApart), 0, 0),
                                  btQuaternion(btVector3(0, 0, 1), btScalar(std::numbers::pi / kTeeth)));
  btHingeConstraint first(driver, btVector3(0, 0, 0), btVector3(0, 0, 1)),
      second(driven, btVector3(0, 0, 0), btVector3(0, 0, 1));
  first.enableAngularMotor(true, -1, 5);
  for (btHingeConstraint* hinge : {&first, &second}) bench.w.world.addConstraint(hinge);
  double turned = 0, turnedBack = 0;
  for (int step = 0; step < 300; ++step) {
    driven.applyTorque(btVector3(0, 0, btScalar(0.5)));  // against which it is held
    bench.w.step();
    turned += double(driver.getAngularVelocity().z()) / 60;
    turnedBack += double(driven.getAngularVelocity().z()) / 60;
  }
  for (btHingeConstraint* hinge : {&first, &second}) bench.w.world.removeConstraint(hinge);
  EXPECT_NEAR(std::abs(turned), 5, 0.1);
  // Within the play of its teeth.
  EXPECT_NEAR(turnedBack, -turned, 0.5 * std::numbers::pi / kTeeth);
}

// A thread of one turn in a quarter of a metre, with a hundredth of a metre of play.
TEST(Mechanisms, ANutRestsOnItsBoltAndFollowsTheThread) {
  constexpr int kSides = 32;
  const double twist = 2 * std::numbers::pi / 0.25;
  const auto thread = [](double play) { return [play](double angle) { return 0.3 + play + 0.04 * std::cos(angle); }; };
  Bench bench;
  bench.add(twisted({thread(0), {}, twist}, kSides, -1, 1, 128), 0, btScalar(0.3), btVector3(0, 0, 0));
  const Tube tube{[](double) { return 0.55; }, thread(0.01), 0, twist};
  btRigidBody& nut = bench.add(twisted(tube, kSides, -0.2, 0.2, 26), 1, btScalar(0.1), btVector3(0, 0, 0));
  bench.w.step(120);
  const double rest = double(nut.getWorldTransform().getOrigin().z());
  EXPECT_NEAR(rest, 0, 0.01);
  EXPECT_LT(double(nut.getLinearVelocity().length()), kStill);
  double turned = 0;
  for (int step = 0; step < 300; ++step) {
    nut.applyTorque(btVector3(0, 0, btScalar(5 * (2 - double(nut.getAngularVelocity().z())))));
    bench.w.step();
    turned += double(nut.getAngularVelocity().z()) / 60;
  }
  EXPECT_GT(turned, 2);
  EXPECT_NEAR(double(nut.getWorldTransform().getOrigin().z()) - rest, turned / twist, 0.04);
}

}  // namespace
}  // namespace cairn::test::mechanisms_test
