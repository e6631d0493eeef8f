// SPDX-License-Identifier: GPL-3.0-or-later
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "../dynamics/compare.h"
#include "../dynamics/pile.h"
#include "isolation_cases.h"

// In the midst of a heap one body's place becomes NaN, or an infinite force acts on it.
//
//    | o O  |          | o    |
//    |O xO O|   ->     |O  O O|   the others: as if it were not there
//    |oOoOoO|          |oOoOoO|
//    '------'          '------'
namespace cairn::hard {
namespace {

constexpr int kBodies = 12, kBefore = 20, kAfter = 120;

// A number still, for which Bullet's solver has room: rocks are 1e10 m deep in what they strike a step later.
constexpr btScalar kAbsurdSpeed = btScalar(1e12);
constexpr int kStruckPiles = 6;

enum class Harm { none, noNumber, infiniteForce, infiniteSpeed, absurdSpeed };

void harm(btRigidBody& body, Harm how) {
  constexpr btScalar kNan = std::numeric_limits<btScalar>::quiet_NaN(),
                     kInf = std::numeric_limits<btScalar>::infinity();
  btTransform at = body.getWorldTransform();
  switch (how) {
    case Harm::none:
      return;
    case Harm::noNumber:
      at.setOrigin(btVector3(kNan, kNan, kNan));
      return body.setCenterOfMassTransform(at);
    case Harm::infiniteForce:
      return body.applyCentralForce(btVector3(0, 0, kInf));
    case Harm::infiniteSpeed:
      return body.setLinearVelocity(btVector3(0, kInf, 0));
    case Harm::absurdSpeed:
      return body.setLinearVelocity(btVector3(0, kAbsurdSpeed, 0));
  }
}

// Islands are not split: Bullet sorts what it solves by island, in an order that depends on how many there are.
void keepOrder(Pile& pile) {
  pile.world().world.getSimulationIslandManager()->setSplitIslands(false);
}

std::uint64_t stateOf(const Pile& pile) {
  StateHash hash;
  for (const btRigidBody* body : pile.bodies()) test::addState(hash, *body);
  return hash.value();
}

// The body harmed hovers among the others, its box in theirs, and touches none. Steps after which the others are not as
// they are when nothing is done to it.
int stepsThatDiffer(const test::TriedBody& tried, Harm how) {
  const btTransform at(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(1.06)));
  Pile healthy(tried, 1, {.bodies = kBodies}), harmed(tried, 1, {.bodies = kBodies});
  btRigidBody* victim = nullptr;
  for (Pile* pile : {&healthy, &harmed}) {
    keepOrder(*pile);
    victim = &pile->world().addTried(tried, at, btScalar(0.5));
    victim->setGravity(btVector3(0, 0, 0));
  }
  int count = 0;
  for (int i = 0; i < kBefore + kAfter; ++i) {
    if (i == kBefore) harm(*victim, how);
    healthy.step();
    harmed.step();
    count += stateOf(healthy) != stateOf(harmed);
  }
  return count;
}

struct Touching {
  int insane = 0;    // of the others
  double speed = 0;  // of the others, the greatest after the harm
};

// The body harmed is one that the others lie on.
Touching harmOneOf(const test::TriedBody& tried, Harm how, std::uint64_t seed = 1) {
  constexpr int kSettling = 90;
  Pile pile(tried, 1, {.bodies = kBodies, .seed = seed});
  Touching result;
  for (int i = 0; i < kSettling + kAfter; ++i) {
    if (i == kSettling) harm(*pile.bodies()[0], how);
    pile.step();
    for (std::size_t k = 1; i >= kSettling && k < pile.bodies().size(); ++k)
      result.speed = std::max(result.speed, double(pile.bodies()[k]->getLinearVelocity().length()));
  }
  result.insane = pile.countInsane() - (test::isSane(*pile.bodies()[0]) ? 0 : 1);
  return result;
}

int brokenByAbsurdSpeed(const test::TriedBody& tried) {
  int insane = 0;
  for (std::uint64_t seed = 1; seed <= kStruckPiles; ++seed) insane += harmOneOf(tried, Harm::absurdSpeed, seed).insane;
  return insane;
}

Outcome runAll(Effort) {
  const std::vector<Asked> asked{{"steps in which others differ, NaN place", 0, Bound::atMost, ""},
                                 {"steps in which others differ, infinite force", 0, Bound::atMost, ""},
                                 {"steps in which others differ, infinite speed", 0, Bound::atMost, ""},
                                 {"others that touched it and are not finite", 0, Bound::atMost, "of 33"},
                                 {"greatest speed of those", 10, Bound::atMost, "m/s"},
                                 {"others that are not finite, beside 1e12 m/s", 0, Bound::atMost, "of 66"}};
  const auto figures = [](const test::TriedBody& body) {
    Figures found;
    double insane = 0, speed = 0;
    for (const Harm how : {Harm::noNumber, Harm::infiniteForce, Harm::infiniteSpeed}) {
      found.push_back(stepsThatDiffer(body, how));
      const Touching touching = harmOneOf(body, how);
      insane += touching.insane;
      speed = std::max(speed, touching.speed);
    }
    found.insert(found.end(), {insane, speed, double(brokenByAbsurdSpeed(body))});
    return found;
  };
  // GImpact is not asked: on a body that touches a NaN place it never ends (Bullet 3.24).
  const CaseBodies& bodies = rocks(1, 1);
  std::vector<Measure> measures =
      besideTheBest(asked, figures(bodies[0].body), {{bodies[1].name, figures(bodies[1].body)}});
  Pile pile(bodies[0].body, 1, {.bodies = 1});
  harm(*pile.bodies()[0], Harm::infiniteSpeed);
  pile.step();
  measures.push_back({"pairs reported as non-finite", double(pile.world().dispatcher.lastStep().nonFinitePairs), 1,
                      Bound::atLeast, "", "", 0});
  return {measures, ""};
}

}  // namespace

HardCase brokenBody() {
  return {
      "I1", "a non-finite body",
      "one body of a heap gets a NaN place, an infinite force or speed: the others are bit for bit as if nothing had "
      "happened, where they do not touch it; where they do, they stay finite and nothing throws them (proposed list)",
      runAll};
}

}  // namespace cairn::hard
