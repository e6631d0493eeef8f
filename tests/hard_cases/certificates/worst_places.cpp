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

constexpr int kMostCompounds = 3, kClimb = 1500;

/// A body's rotation, those of the compounds' children in it, and the tree's own, one after the other; where both
/// stand; how large the second is; its point.
struct Place {
  std::vector<btQuaternion> turnsA, turnsB;
  btVector3 at, apart;
  double scale = 1;
  Vec3 pointInB;
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
  place.pointInB = bullet::toVec3(dice.vector(1));
  return place;
}

Place besides(Place place, Dice& dice) {
  const double size = std::pow(10, -5 * std::abs(dice.draw()));
  const std::size_t which = dice.oneOf(place.turnsA.size());
  switch (dice.oneOf(8)) {
    case 0:
      place.pointInB = place.pointInB + bullet::toVec3(dice.vector(size));
      break;
    case 1:
      place.apart += dice.vector(size);
      break;
    case 2:
      place.scale *= std::exp(dice.draw() * size);
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

Shared look(const Place& place) {
  Shared shared{poseOf(place.turnsA, place.at, 1), poseOf(place.turnsB, place.at + place.apart, place.scale), {}};
  const Wide turned = WideMatrix(shared.b.rotation) * Wide(place.pointInB);
  const Wide world = turned * static_cast<long double>(shared.b.scale) + Wide(shared.b.translation);
  shared.pointInA = WideMatrix(shared.a.rotation).solved(world - Wide(shared.a.translation));
  const Similarity inA = relativePose(shared.a, shared.b);
  const Wide moved(inA * place.pointInB);
  const long double lengths =
      length(inA.translation) + std::sqrt(lengthSq(shared.pointInA)) + inA.scale * length(place.pointInB);
  shared.used = double(std::sqrt(lengthSq(shared.pointInA - moved)) / lengths) / double(kOverlapSlack);
  return shared;
}

Place climb(int products, Dice& dice) {
  Place best = randomPlace(products, dice);
  double used = look(best).used;
  for (int i = 0; i < kClimb; ++i) {
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

WorstPlaces climbToWorstPlaces(int starts, std::mt19937_64& engine) {
  Dice dice(engine);
  WorstPlaces worst;
  for (int products = 1; products <= 1 + kMostCompounds; ++products)
    for (int start = 0; start < starts; ++start) {
      const Place place = climb(products, dice);
      const Shared shared = look(place);
      const SphereTree a = probeTree(std::vector<Wide>(kProbes, shared.pointInA));
      const SphereTree b = probeTree(std::vector<Wide>(kProbes, Wide(place.pointInB)));
      ++worst.places;
      worst.lost += namesAll(a, b, shared.a, shared.b) && namesAll(b, a, shared.b, shared.a) ? 0 : 1;
      worst.used = std::max(worst.used, shared.used);
    }
  return worst;
}

}  // namespace cairn::hard
