// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificates/worst_places.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "cairn/core/family.h"
#include "cairn/core/tree_pair_traversal.h"
#include "certificates/probe_tree.h"
#include "certificates/wide_matrix.h"
#include "placement/bullet_math.h"

namespace cairn::hard {
namespace {

constexpr int kMaxCompounds = 4;
constexpr double kMinScale = 1e-3;
constexpr float kMinRadius = 1e-6F;
/// Of a search for one turn: so many climbs of so many steps.
constexpr int kTurnStarts = 10, kTurnSteps = 4000;

/// A body's rotation, those of the compounds' children in it, and the tree's own, one after the other; where both
/// stand; how large the second is; a ball of it, and where on that ball the shared point is.
struct Place {
  std::vector<btQuaternion> turnsA, turnsB;
  btVector3 at, apart;
  double scale = 1;
  Sphere ballInB;
  btVector3 outward;

  /// Inside the ball for certain, by less than matters.
  Wide pointInB() const {
    const Wide way(bullet::toVec3d(outward));
    return Wide(ballInB.center) + way * (static_cast<long double>(ballInB.radius) * (1 - 0x1p-50L) / length(way));
  }
};

class Dice {
 public:
  explicit Dice(std::mt19937_64& engine) : engine_(engine) {}

  double draw() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  std::uint64_t oneOf(std::uint64_t count) { return engine_() % count; }
  btVector3 vector(double size) {
    const double x = draw(), y = draw(), z = draw();
    return {btScalar(x * size), btScalar(y * size), btScalar(z * size)};
  }
  btQuaternion turnNear(const btQuaternion& q, double size) {
    const double x = draw(), y = draw(), z = draw(), w = draw();
    return btQuaternion(q.x() + btScalar(x * size), q.y() + btScalar(y * size), q.z() + btScalar(z * size),
                        q.w() + btScalar(w * size))
        .normalized();
  }

 private:
  std::mt19937_64& engine_;
};

/// How much longer a matrix makes the vector that it makes longest, in parts, or shorter for `sign` -1.
double stretchOf(const btMatrix3x3& matrix, double sign) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = double(matrix[i][j]);
  const Eigen::Matrix3d excess = sign / 2 * (m.transpose() * m - Eigen::Matrix3d::Identity());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
      .computeDirect(excess, Eigen::EigenvaluesOnly)
      .eigenvalues()[2];
}

btQuaternion climbToStretch(const btMatrix3x3& before, double sign, Dice& dice) {
  btQuaternion turn = dice.turnNear(btQuaternion(0, 0, 0, 0), 1);
  double stretch = stretchOf(before * btMatrix3x3(turn), sign);
  for (int i = 0; i < kTurnSteps; ++i) {
    const btQuaternion next = dice.turnNear(turn, std::pow(10, -7 * std::abs(dice.draw())));
    const double nextStretch = stretchOf(before * btMatrix3x3(next), sign);
    if (nextStretch <= stretch) continue;
    stretch = nextStretch;
    turn = next;
  }
  return turn;
}

/// Turns whose product stretches most, one after the other: each adds to what is there. All of them at once hardly
/// climb.
std::vector<btQuaternion> stretchingTurns(int count, double sign, Dice& dice) {
  std::vector<btQuaternion> turns;
  btMatrix3x3 product = btMatrix3x3::getIdentity();
  while (int(turns.size()) < count) {
    btQuaternion best = climbToStretch(product, sign, dice);
    for (int i = 1; i < kTurnStarts; ++i) {
      const btQuaternion other = climbToStretch(product, sign, dice);
      if (stretchOf(product * btMatrix3x3(other), sign) > stretchOf(product * btMatrix3x3(best), sign)) best = other;
    }
    turns.push_back(best);
    product = product * btMatrix3x3(best);
  }
  return turns;
}

/// One that stretches as much as can be found and one that does the contrary: both widen what is between a moved
/// point and where it ought to be.
Place stretchingPlace(int products, Dice& dice) {
  Place place;
  const double sign = dice.oneOf(2) == 0 ? 1 : -1;
  place.turnsA = stretchingTurns(products + 1, sign, dice);
  place.turnsB = stretchingTurns(products + 1, -sign, dice);
  place.scale = std::pow(10, 2 * dice.draw());
  place.at = dice.vector(10);
  place.apart = dice.vector(1);
  place.ballInB = {bullet::toVec3(dice.vector(1)), float(std::pow(10, 3 * dice.draw() - 2))};
  place.outward = dice.vector(1);
  return place;
}

Place besides(Place place, Dice& dice) {
  const double size = std::pow(10, -5 * std::abs(dice.draw()));
  const std::size_t which = dice.oneOf(place.turnsA.size());
  switch (dice.oneOf(12)) {
    case 0:
      place.ballInB.center = place.ballInB.center + bullet::toVec3(dice.vector(size));
      break;
    case 1:
      place.apart += dice.vector(size);
      break;
    case 2:
      place.scale = std::clamp(place.scale * std::exp(dice.draw() * size), kMinScale, 1 / kMinScale);
      break;
    case 3:
      place.ballInB.radius = std::clamp(place.ballInB.radius * float(std::exp(dice.draw() * size)), kMinRadius, 1.0F);
      break;
    case 4:
      place.outward = (place.outward + dice.vector(size)).normalized();
      break;
    default: {
      btQuaternion& turn = (dice.oneOf(2) == 0 ? place.turnsA : place.turnsB)[which];
      turn = dice.turnNear(turn, size);
    }
  }
  return place;
}

/// As Bullet and the plugin multiply them.
Pose poseOf(const std::vector<btQuaternion>& turns, const btVector3& at, double scale) {
  btTransform transform(turns.front(), at);
  for (std::size_t i = 1; i < turns.size(); ++i) transform = transform * btTransform(turns[i], btVector3(0, 0, 0));
  return {bullet::toMat3d(transform.getBasis()), bullet::toVec3d(transform.getOrigin()), double(btScalar(scale))};
}

struct Shared {
  Pose a, b;
  Wide pointInA;
  double used = 0;
};

/// The ball's centre is moved. The slack has to cover the distance from it to the point, less the radius.
Shared look(const Place& place) {
  Shared shared{poseOf(place.turnsA, place.at, 1), poseOf(place.turnsB, place.at + place.apart, place.scale), {}};
  const Wide turned = WideMatrix(shared.b.rotation) * place.pointInB();
  const Wide world = turned * static_cast<long double>(shared.b.scale) + Wide(shared.b.translation);
  shared.pointInA = WideMatrix(shared.a.rotation).solved(world - Wide(shared.a.translation));
  const Similarity inA = relativePose(shared.a, shared.b);
  const Sphere& ball = place.ballInB;
  const auto radius = static_cast<long double>(inA.scale) * static_cast<long double>(ball.radius);
  const long double lengths = length(inA.translation) + length(shared.pointInA) +
                              static_cast<long double>(inA.scale) * length(Wide(ball.center)) + radius;
  const long double beyond = length(shared.pointInA - Wide(inA * ball.center)) - radius;
  shared.used = double(beyond / lengths) / double(kOverlapSlack);
  return shared;
}

Place climb(int products, int steps, Dice& dice) {
  Place best = stretchingPlace(products, dice);
  double used = look(best).used;
  for (int i = 0; i < steps; ++i) {
    const Place next = besides(best, dice);
    const double nextUsed = look(next).used;
    if (nextUsed <= used) continue;
    used = nextUsed;
    best = next;
  }
  return best;
}

bool namesAll(const SphereTree& first, const SphereTree& second, const Pose& a, const Pose& b) {
  TreePairTraversal traversal;
  traversal.start(first, second, a, b, 0);
  Budget budget = Budget::unlimited();
  (void)traversal.refine(budget);
  return traversal.leafPairs().size() == std::size_t{kProbes} * kProbes;
}

}  // namespace

WorstPlaces climbToWorstPlaces(int starts, int steps, std::mt19937_64& engine) {
  Dice dice(engine);
  WorstPlaces worst;
  for (int compounds = 0; compounds <= kMaxCompounds; ++compounds) {
    double& used = worst.usedByDepth.emplace_back(0);
    for (int start = 0; start < starts; ++start) {
      const Place place = climb(compounds + 1, steps, dice);
      const Shared shared = look(place);
      const SphereTree a = probeTree(std::vector<Wide>(kProbes, shared.pointInA));
      const SphereTree b = probeTree(place.ballInB);
      ++worst.places;
      worst.lost += namesAll(a, b, shared.a, shared.b) && namesAll(b, a, shared.b, shared.a) ? 0 : 1;
      used = std::max(used, shared.used);
    }
  }
  return worst;
}

}  // namespace cairn::hard
