// SPDX-License-Identifier: GPL-3.0-or-later
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

#include "../dynamics/compare.h"
#include "../dynamics/pile.h"
#include "isolation_cases.h"

// The same heap in a fresh world, again in the same process, and beside another far away.
//
//    |oOo|     |oOo|     |oOo|  . . . 1 km . . .  |OoO|
//      =         =         =                       any
namespace cairn::hard {
namespace {

constexpr std::uint64_t kHeaps = 3;

struct Circumstances {
  bool withIsland = false;
  std::optional<std::int64_t> operations = {};
};

std::uint64_t hashOf(const test::TriedBody& tried, std::uint64_t seed, int steps, const Circumstances& how) {
  Pile pile(tried, 1, {.bodies = 12, .seed = seed, .doSleep = true});
  if (how.operations && !pile.world().dispatcher.setBudget({*how.operations, {}}).ok()) return 0;
  // Or Bullet sorts what it solves by island, in an order that depends on how many there are.
  pile.world().world.getSimulationIslandManager()->setSplitIslands(false);
  if (how.withIsland) {
    constexpr btScalar kFar = 1000;
    pile.world().add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(kFar, kFar, 50));
    for (int i = 0; i < 6; ++i)
      pile.world().addTried(
          tried,
          btTransform(btQuaternion::getIdentity(), btVector3(kFar + btScalar(0.1 * i), kFar, 52 + btScalar(1.1 * i))),
          btScalar(0.5));
  }
  StateHash hash;
  for (int i = 0; i < steps; ++i) {
    pile.step();
    for (const btRigidBody* body : pile.bodies()) test::addState(hash, *body);
  }
  return hash.value();
}

Figures heapsThatDiffer(const test::TriedBody& tried, int steps) {
  double again = 0, besideIsland = 0, starvedAgain = 0;
  for (std::uint64_t seed = 1; seed <= kHeaps; ++seed) {
    const auto hash = [&](const Circumstances& how) { return hashOf(tried, seed, steps, how); };
    const std::uint64_t alone = hash({});
    again += alone != hash({});
    besideIsland += alone != hash({.withIsland = true});
    starvedAgain += hash({.operations = 500}) != hash({.operations = 500});
  }
  return {again, besideIsland, starvedAgain};
}

Outcome runSameBits(Effort effort) {
  const int steps = effort == Effort::whole ? 1200 : 180;
  const std::vector<Asked> asked{{"heaps that differ in a second run", 0, Bound::atMost, "of 3"},
                                 {"heaps that differ beside a far island", 0, Bound::atMost, "of 3"},
                                 {"on 500 operations, differ in a second run", 0, Bound::atMost, "of 3"}};
  return {compare(asked, rocks(1, 1), [&](const CaseBody& body) { return heapsThatDiffer(body.body, steps); }), ""};
}

}  // namespace

HardCase sameBits() {
  return {
      "I2", "the same bits",
      "three heaps of 12 rocks, 20 s each: equal state hashes in fresh worlds, and with an unrelated heap a kilometre "
      "away (PEEL's determinism scene); threads are asked by the preset threads, compilers by golden_hash",
      runSameBits};
}

}  // namespace cairn::hard
