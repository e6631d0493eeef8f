// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificates/worst_places.h"

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

constexpr int kMostCompounds = 4;
constexpr double kLeastScale = 1e-3;
constexpr float kLeastRadius = 1e-6F;

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

Place randomPlace(int products, Dice& dice) {
  Place place;
  for (int i = 0; i <= products; ++i) {
    place.turnsA.push_back(dice.turnNear(btQuaternion(0, 0, 0, 0), 1));
    place.turnsB.push_back(dice.turnNear(btQuaternion(0, 0, 0, 0), 1));
  }
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
      place.scale = std::clamp(place.scale * std::exp(dice.draw() * size), kLeastScale, 1 / kLeastScale);
      break;
    case 3:
      place.ballInB.radius = std::clamp(place.ballInB.radius * float(std::exp(dice.draw() * size)), kLeastRadius, 1.0F);
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

/// What moving the ball's centre leaves between it and the point, beyond its radius, is what the slack has to cover.
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
  Place best = randomPlace(products, dice);
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
  for (int compounds = 0; compounds <= kMostCompounds; ++compounds) {
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
