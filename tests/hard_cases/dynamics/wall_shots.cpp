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

Outcome run(Effort effort) {
  const int count = effort == Effort::whole ? 1000 : 60;
  const auto kind = [](const CaseBodies& bodies, std::size_t i) { return bodies[i].body; };
  const Vec3d rod(1, 0.3, 0.3);
  std::vector<Bullets> all;
  for (std::size_t i = 0; i < 4; ++i) all.push_back({balls(0.4)[i].name, {kind(boxes(rod), i), kind(balls(0.4), i)}});
  all[1].name = "box, sphere";
  all[0].kinds.push_back(rocks(1, 0.9)[0].body);
  const auto box =
      std::make_shared<btBoxShape>(btVector3(btScalar(kWidth), btScalar(kWidth), btScalar(kThickness)) / 2);
  const auto tree = treeOf(test::cuboid({kWidth, kWidth, kThickness}, 8), 3);
  const std::vector<Asked> asked{{"through a box", 0, Bound::atMost, "of " + std::to_string(count)},
                                 {"through a tree", 0, Bound::atMost, "of " + std::to_string(count)}};
  std::vector<StockRun> stock;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double passed = through(all[i], box, count);
    stock.push_back({all[i].name, {passed, passed}});  // Bullet's own wall is the box
  }
  return {besideTheBest(asked, {double(through(all[0], box, count)), double(through(all[0], tree, count))}, stock), ""};
}

}  // namespace

HardCase wallShots() {
  return {"D6", "shots at a thin wall",
          "1000 rods, balls and rocks at 10 to 300 m/s, continuous collision on: none through a wall of 0.1 m "
          "(proposed list)",
          run};
}

}  // namespace cairn::hard
