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

std::uint64_t hashOf(const test::TriedBody& tried, bool withIsland, int steps, std::optional<std::int64_t> operations) {
  Pile pile(tried, 1, {.bodies = 12, .doSleep = true});
  if (operations && !pile.world().dispatcher.setBudget({*operations, {}}).ok()) return 0;
  // Or Bullet sorts what it solves by island, in an order that depends on how many there are.
  pile.world().world.getSimulationIslandManager()->setSplitIslands(false);
  if (withIsland) {
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

Outcome runSameBits(Effort effort) {
  const int steps = effort == Effort::whole ? 1200 : 180;
  const std::vector<Asked> asked{{"second run in the process differs", 0, Bound::atMost, ""},
                                 {"a far island makes it differ", 0, Bound::atMost, ""},
                                 {"on 500 operations, second run differs", 0, Bound::atMost, ""}};
  return {compare(asked, rocks(1, 1),
                  [&](const CaseBody& body) -> Figures {
                    const std::uint64_t alone = hashOf(body.body, false, steps, {});
                    const std::uint64_t starved = hashOf(body.body, false, steps, 500);
                    return {double(alone != hashOf(body.body, false, steps, {})),
                            double(alone != hashOf(body.body, true, steps, {})),
                            double(starved != hashOf(body.body, false, steps, 500))};
                  }),
          ""};
}

}  // namespace

HardCase sameBits() {
  return {"I2", "the same bits",
          "a heap of 12 rocks, 20 s: equal state hashes in fresh worlds, and with an unrelated heap a kilometre away "
          "(PEEL's determinism scene)",
          runSameBits};
}

}  // namespace cairn::hard
