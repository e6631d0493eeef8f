// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"
#include "pile.h"
#include "scenes/figures/random.h"

// 216 balls fall in a cube of six by six by six into a pit as wide.
//
//    |oooooo|
//    |oooooo|
//    |oooooo|
//    '------'
namespace cairn::hard {
namespace {

constexpr double kRadius = 0.25;

struct Pit {
  double radius, halfWidth;

  // By the balls' places, whatever their contacts say.
  double deepest(const std::vector<btRigidBody*>& balls) const {
    double deepest = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (!test::isSane(*balls[i])) return NAN;
      const btVector3& p = balls[i]->getWorldTransform().getOrigin();
      const double wall = halfWidth - double(btMax(btFabs(p.x()), btFabs(p.y())));
      deepest = test::greatest(deepest, radius - std::min(wall, double(p.z())));
      for (std::size_t k = 0; k < i; ++k)
        deepest =
            test::greatest(deepest, 2 * radius - double((p - balls[k]->getWorldTransform().getOrigin()).length()));
    }
    return deepest;
  }
};

btVector3 placeOf(int i, int side, double spacing, std::uint64_t seed) {
  scenes::Random random(seed, std::uint64_t(i));
  const auto aside = [&] { return random.uniform(-0.02, 0.02) * kRadius; };  // or they would stand on each other
  const double half = side / 2.0;
  const double x = (i % side + 0.5 - half) * spacing + aside();
  const double y = (i / side % side + 0.5 - half) * spacing + aside();
  const double z = (i / (side * side) + 0.5) * 1.2 * spacing + aside();
  return btVector3(btScalar(x), btScalar(y), btScalar(z));
}

struct Drop {
  int side;
  double seconds;
  int stepsPerSecond = test::kStepsPerSecond;
  bool isContinuous = false;  // by Bullet's own switch, each body's
};

void lookAhead(btRigidBody& ball, double radius) {
  constexpr double kMotion = 0.1, kSwept = 0.4;  // of the radius: how far in a step at least, and with what ball
  ball.setCcdMotionThreshold(btScalar(kMotion * radius));
  ball.setCcdSweptSphereRadius(btScalar(kSwept * radius));
}

Figures fall(const test::TriedBody& ball, const Drop& how, std::uint64_t seed) {
  const int side = how.side;
  const double radius = kRadius + double(ball.margin), spacing = 2.05 * radius;
  const Pit pit{radius, side * spacing / 2};
  test::StillWorld w;
  w.addGround();
  for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
    w.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-pit.halfWidth)), 0, btVector3(0, 0, 0));
  std::vector<btRigidBody*> bodies;
  for (int i = 0; i < side * side * side; ++i)
    bodies.push_back(
        &w.addTried(ball, btTransform(btQuaternion::getIdentity(), placeOf(i, side, spacing, seed)), btScalar(0.5)));
  if (how.isContinuous)
    for (btRigidBody* body : bodies) lookAhead(*body, radius);
  double deepest = 0, peak = 0, kinetic = 0;
  for (int i = 0; i < int(how.seconds * how.stepsPerSecond); ++i) {
    w.world.stepSimulation(btScalar(1) / btScalar(how.stepsPerSecond), 0);
    deepest = test::greatest(deepest, pit.deepest(bodies));
    kinetic = 0;
    for (const btRigidBody* body : bodies) kinetic += kineticEnergyOf(*body);
    peak = std::isfinite(kinetic) ? std::max(peak, kinetic) : kinetic;
  }
  return {100 * deepest / radius, kinetic / peak};
}

constexpr const char* kWhyDeep =
    "In a step of 60 Hz a ball that fell a metre moves by 30 % of its radius. Bullet sees a hull's points 3.6 % of the "
    "radius before they touch, a tree's 0.7 %; a hull seen that late goes 31 % deep.";

Outcome runBallPit(Effort effort) {
  const bool isWhole = effort == Effort::whole;
  const int side = isWhole ? 6 : 3, seeds = isWhole ? 9 : 3;
  const Drop atSixty{.side = side, .seconds = isWhole ? 15.0 : 4.0};
  // Blows come first: what is deepest is so within two seconds.
  const Drop finely{.side = side, .seconds = 2, .stepsPerSecond = 240};
  const Drop ahead{.side = side, .seconds = finely.seconds, .isContinuous = true};
  const std::vector<Asked> asked{
      {"deepest penetration", 10, Bound::atMost, "% of the radius"},
      {"kinetic energy at the end", isWhole ? 1e-3 : 1e-2, Bound::atMost, "of its peak"},
      {"deepest penetration, 240 steps a second", 10, Bound::atMost, "% of the radius"},
      {"deepest penetration, with continuous collision", 10, Bound::atMost, "% of the radius"}};
  const auto run = [&](const CaseBody& body, std::uint64_t seed) {
    Figures figures = fall(body.body, atSixty, seed);
    for (const Drop& other : {finely, ahead}) figures.push_back(fall(body.body, other, seed).front());
    return figures;
  };
  return {compareSeeds(
              asked, seeds, [](std::uint64_t) -> const CaseBodies& { return balls(kRadius); }, run),
          kWhyDeep};
}

}  // namespace

HardCase ballPit() {
  return {"D11", "a pit of balls",
          "216 balls, 15 s at 60 Hz, the median of nine pits: never deeper than 10 % of the radius (margin included), "
          "kinetic energy down to a thousandth of its peak (proposed list); as deep with steps a quarter as long, and "
          "with continuous collision",
          runBallPit};
}

}  // namespace cairn::hard
