// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"
#include "rolling.h"

// Ten kilometres out a float is a millimetre wide: a ball rolls down all the same.
//
//    0 . . . . . . . . . . 10 km . . .  (o
//                                     -.__ '-.
namespace cairn::hard {
namespace {

constexpr double kFar = 1e4;

/// Directions in which it is far: along the axes, across them, and one at random, high up.
const std::vector<btVector3>& places() {
  static const std::vector<btVector3> all = [] {
    std::vector<btVector3> directions{{1, 0, 0},
                                      {0, 1, 0},
                                      {0, 0, 1},
                                      {0, 0, -1},
                                      {1, -1, btScalar(0.1)},
                                      {1, 1, 1},
                                      {-1, 1, -1},
                                      {btScalar(0.29), btScalar(0.39), btScalar(-0.87)}};
    for (btVector3& direction : directions) direction = direction.normalized() * btScalar(kFar);
    return directions;
  }();
  return all;
}

Figures offFarOut(const CaseBody& body) {
  const double here = rollDown(body.body, {});
  std::vector<double> off;
  for (const btVector3& place : places()) off.push_back(100 * std::abs(rollDown(body.body, {.at = place}) / here - 1));
  return {quantileOf(off, 0.5, Bound::atMost), quantileOf(off, 1, Bound::atMost)};
}

Outcome runFarFromOrigin(Effort) {
  const std::vector<Asked> asked{{"rolling, off that at the origin, median of eight places", 1, Bound::atMost, "%"},
                                 {"rolling, off that at the origin, worst of them", 1.5, Bound::atMost, "%"}};
  return {compare(asked, balls(0.5), offFarOut),
          "The list asks 1 % or a documented limit: 1.5 % where height is the far coordinate, as contacts' places are "
          "known to a millimetre there, a five-hundredth of the ball's radius; Bullet's sphere needs no place."};
}

}  // namespace

HardCase farFromOrigin() {
  return {
      "D14", "ten kilometres from the origin",
      "a ball rolls down a slope at eight places 10 km out: within 1 % of what it does at the origin, in the worst of "
      "them within 1.5 %, in single precision (proposed list: 1 % or a documented limit)",
      runFarFromOrigin};
}

}  // namespace cairn::hard
