// SPDX-License-Identifier: GPL-3.0-or-later
#include "../dynamics/compare.h"
#include "../dynamics/pile.h"
#include "cairn/bullet/ordered_solver.h"
#include "isolation_cases.h"

// The same heap in a fresh world, again in the same process, and below another far above.
//
//                                   |
//    |   |     |   |     |   |    1 km     Oo  any
//    |   |     |   |     |   |      |     ====
//    |oOo|     |oOo|     |oOo|  . . . . . |oOo|
//      =         =         =                =
namespace cairn::hard {
namespace {

constexpr std::uint64_t kHeaps = 3;

struct Circumstances {
  bool withIsland = false;
  std::optional<std::int64_t> operations = {};
};

// Not aside, where the walls of the pit, which are planes, would press it towards the heap.
void addIsland(Pile& pile, const test::TriedBody& tried) {
  constexpr btScalar kFar = 1000;
  pile.world().add(std::make_shared<btBoxShape>(btVector3(5, 5, 1)), 0, btVector3(0, 0, kFar));
  for (int i = 0; i < 6; ++i) {
    const btVector3 at(btScalar(0.1 * i), 0, kFar + 2 + btScalar(1.1 * i));
    pile.world().addTried(tried, btTransform(btQuaternion::getIdentity(), at), btScalar(0.5));
  }
}

std::uint64_t hashOf(const CaseBody& body, std::uint64_t seed, int steps, const Circumstances& how) {
  Pile pile(body.body, 1, {.bodies = 12, .seed = seed, .doSleep = true});
  if (how.operations && !pile.world().dispatcher.setBudget({*how.operations, {}}).ok()) return 0;
  // The means of each: Bullet's switch is enough where a pair has one manifold.
  bullet::OrderedSolver<> ordered;
  btConstraintSolver* const own = pile.world().world.getConstraintSolver();
  const bool isTree = body.name == "tree";
  if (isTree) pile.world().world.setConstraintSolver(&ordered);
  pile.world().world.getDispatchInfo().m_deterministicOverlappingPairs = !isTree;
  if (how.withIsland) addIsland(pile, body.body);
  StateHash hash;
  for (int i = 0; i < steps; ++i) {
    pile.step();
    for (const btRigidBody* rock : pile.bodies()) test::addState(hash, *rock);
  }
  pile.world().world.setConstraintSolver(own);
  return hash.value();
}

Figures heapsThatDiffer(const CaseBody& body, int steps) {
  double again = 0, besideIsland = 0, starvedAgain = 0;
  for (std::uint64_t seed = 1; seed <= kHeaps; ++seed) {
    const auto hash = [&](const Circumstances& how) { return hashOf(body, seed, steps, how); };
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
  return {compare(asked, rocks(1, 1), [&](const CaseBody& body) { return heapsThatDiffer(body, steps); }), ""};
}

}  // namespace

HardCase sameBits() {
  return {
      "I2", "the same bits",
      "three heaps of 12 rocks, 20 s each: equal state hashes in fresh worlds, and with an unrelated heap a kilometre "
      "away, of trees by OrderedSolver, of Bullet's shapes by m_deterministicOverlappingPairs (PEEL's determinism "
      "scene); threads are asked by the preset threads, compilers by golden_hash",
      runSameBits};
}

}  // namespace cairn::hard
