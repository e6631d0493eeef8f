// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare.h"
#include "dynamics_cases.h"

// Two bodies that begin a quarter, half and nine tenths in each other, nothing else acting, must part gently and each
// to its own side.
//
//      .---+--.---.
//     |    |  |    |
//     | <- |  | -> |
//      '---+--'---'
namespace cairn::hard {
namespace {

struct Parting {
  double speed = 0;    // greatest of either, m/s
  double crossed = 0;  // 1 if they changed sides
  double left = 0;     // per cent of the overlap they began with, at the end
};

Parting part(const test::TriedBody& body, double width, double overlap, double seconds) {
  constexpr int kPartingStepsPerSecond = 60;
  test::StillWorld w;
  w.world.setGravity(btVector3(0, 0, 0));
  // A little aside of each other and turned: nothing is symmetric.
  const btScalar apart = btScalar((1 - overlap) * width / 2);
  const btVector3 aside(0, btScalar(0.01 * width), btScalar(0.02 * width));
  btRigidBody& left =
      w.addTried(body, btTransform(btQuaternion::getIdentity(), btVector3(-apart, 0, 0)), btScalar(0.5));
  btRigidBody& right =
      w.addTried(body, btTransform(btQuaternion(btVector3(1, 0, 0), btScalar(0.05)), btVector3(apart, 0, 0) + aside),
                 btScalar(0.5));
  for (btRigidBody* each : {&left, &right}) each->setGravity(btVector3(0, 0, 0));
  const btVector3 before = right.getWorldTransform().getOrigin() - left.getWorldTransform().getOrigin();
  Parting result;
  for (int i = 0; i < int(seconds * kPartingStepsPerSecond); ++i) {
    w.step();
    for (const btRigidBody* each : {&left, &right}) {
      if (!test::isSane(*each)) return {std::numeric_limits<double>::quiet_NaN(), 1, 100};
      result.speed = std::max(result.speed, double(each->getLinearVelocity().length()));
    }
    const btVector3 now = right.getWorldTransform().getOrigin() - left.getWorldTransform().getOrigin();
    if (now.dot(before) < 0) result.crossed = 1;
  }
  w.world.performDiscreteCollisionDetection();
  result.left = 100 * test::touching(w.dispatcher).penetration / (overlap * width);
  // Nobody need say anything of bodies that overlap: their centres must have parted by half of it at least.
  const btVector3 after = right.getWorldTransform().getOrigin() - left.getWorldTransform().getOrigin();
  const double parted = double(after.length() - before.length());
  result.left = test::greatest(result.left, parted >= overlap * width / 2 ? 0 : 100);
  return result;
}

Outcome runDeepOverlap(Effort effort) {
  const double seconds = effort == Effort::whole ? 10 : 3;
  const std::vector<Asked> asked{
      {"cubes, greatest speed", 3, Bound::atMost, "m/s"},    {"cubes that change sides", 0, Bound::atMost, "of 3"},
      {"cubes, overlap left", 10, Bound::atMost, "%"},       {"rocks, greatest speed", 3, Bound::atMost, "m/s"},
      {"rocks that change sides", 0, Bound::atMost, "of 3"}, {"rocks, overlap left", 10, Bound::atMost, "%"}};
  const auto figures = [&](const CaseBodies& bodies, const std::string& name, double width) -> Figures {
    const auto found = std::ranges::find(bodies, name, &CaseBody::name);
    if (found == bodies.end()) return Figures(3, std::numeric_limits<double>::quiet_NaN());
    Figures worst(3, 0);
    for (const double overlap : {0.25, 0.5, 0.9}) {
      const Parting run = part(found->body, width, overlap, seconds);
      worst = {std::max(worst[0], run.speed), worst[1] + run.crossed, std::max(worst[2], run.left)};
    }
    return worst;
  };
  // As wide as this rock is along x, about.
  constexpr double kRockWidth = 0.6;
  return {compare(asked, cubes(1),
                  [&](const CaseBody& body) {
                    Figures both = figures(cubes(1), body.name, 1);
                    const Figures ofRocks = figures(rocks(1, 1), body.name, kRockWidth);
                    both.insert(both.end(), ofRocks.begin(), ofRocks.end());
                    return both;
                  }),
          ""};
}

}  // namespace

HardCase deepOverlap() {
  return {"D5", "deep in each other",
          "two cubes, two rocks, 25, 50 and 90 % in each other, weightless: they part, no faster than 3 m/s, neither "
          "through the other (proposed list)",
          runDeepOverlap};
}

}  // namespace cairn::hard
