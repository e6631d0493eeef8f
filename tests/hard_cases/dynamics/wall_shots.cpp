// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare.h"
#include "dynamics_cases.h"
#include "shots.h"

// A wall of ten centimetres, what is shot at it at 10 to 300 m/s from a random distance: a step takes it up to five
// metres on.
//
//           |#|
//   o --->  |#|   . . . o ?
//           |#|
namespace cairn::hard {
namespace {

constexpr double kWidth = 8, kThickness = 0.1;

struct Bullets {
  std::string name;
  std::vector<test::TriedBody> kinds;
};

int through(const Bullets& bullets, const std::shared_ptr<btCollisionShape>& wall, int count) {
  std::mt19937 random(test::kSeed);
  int passed = 0;
  for (int i = 0; i < count; ++i) {
    const test::Shot shot = test::randomShot(random);
    test::StillWorld w;
    w.world.setGravity(btVector3(0, 0, 0));
    w.add(wall, 0, btVector3(0, 0, 0));
    const test::TriedBody& kind = bullets.kinds[std::size_t(i) % bullets.kinds.size()];
    btRigidBody& body = w.addTried(kind, btTransform(shot.rotation, shot.from), btScalar(0.5));
    body.setLinearVelocity(shot.velocity);
    body.setAngularVelocity(shot.spin);
    body.setCcdMotionThreshold(btScalar(0.05));
    body.setCcdSweptSphereRadius(btScalar(0.15));  // Bullet's own sweep; within the thinnest
    passed += test::passesThrough(w, body, false) ? 1 : 0;
  }
  return passed;
}

Outcome runWallShots(Effort effort) {
  const int count = effort == Effort::whole ? 1000 : 60;
  const CaseBodies &rods = boxes({1, 0.3, 0.3}), &round = balls(0.4);
  // Of Bullet's shapes only convex ones are looked ahead for.
  const Bullets ours{"tree", {rods[0].body, round[0].body, rocks(1, 0.9)[0].body}},
      own{"box, sphere", {rods[1].body, round[1].body}};
  const auto box =
      std::make_shared<btBoxShape>(btVector3(btScalar(kWidth), btScalar(kWidth), btScalar(kThickness)) / 2);
  const auto tree = treeOf(test::cuboid({kWidth, kWidth, kThickness}, 8), 3);
  const std::vector<Asked> asked{{"through a box", 0, Bound::atMost, "of " + std::to_string(count)},
                                 {"through a tree", 0, Bound::atMost, "of " + std::to_string(count)}};
  const double stock = through(own, box, count);  // Bullet's own wall is the box
  return {besideTheBest(asked, {double(through(ours, box, count)), double(through(ours, tree, count))},
                        {{own.name, {stock, stock}}}),
          ""};
}

}  // namespace

HardCase wallShots() {
  return {"D6", "shots at a thin wall",
          "1000 rods, balls and rocks at 10 to 300 m/s, continuous collision on: none through a wall of 0.1 m "
          "(proposed list)",
          runWallShots};
}

}  // namespace cairn::hard
