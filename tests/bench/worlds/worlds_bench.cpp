// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of bodies at rest beside a hundred that move: time of Bullet's pass over all pairs, and memory. Beside
// sphere-trees Bullet's own balls, whose cost is Bullet's loop alone.
#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "cairn/core/tree_file.h"
#include "cpu_seconds.h"
#include "test_trees.h"

namespace cairn::bench {
namespace {

constexpr int kMoving = 100;
constexpr int kSettling = 60, kLying = 20, kResting = 600, kMeasured = 60;  // steps
constexpr double kRadius = 0.5;
constexpr double kApart = 0.999;  // of the diameter: neighbours touch, in four directions

struct Options {
  std::string tree;
  std::vector<int> still{0, 900, 9900};
  int runs = 5;
};

double bytesInUse() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Tells how long Bullet's pass over the pairs of a step takes.
template <class Base>
class TimedDispatcher : public Base {
 public:
  using Base::Base;
  void dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                 btDispatcher* dispatcher) override {
    const double before = cpuSeconds();
    Base::dispatchAllCollisionPairs(pairs, info, dispatcher);
    seconds = cpuSeconds() - before;
  }
  double seconds = 0;
};

struct Cost {
  double microseconds = 0, bytesAwake = 0, bytes = 0;
  int pairs = 0;
  int woken = 0;
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
  return values[values.size() / 2];
}

template <class Dispatcher>
Cost costOf(const std::shared_ptr<btCollisionShape>& shape, int still) {
  test::BulletWorld<TimedDispatcher<Dispatcher>> w;
  w.world.setForceUpdateAllAabbs(false);
  w.addGround();
  btVector3 lower, upper;
  shape->getAabb(btTransform::getIdentity(), lower, upper);
  const btVector3 apart = (upper - lower) * btScalar(kApart);
  const auto at = [&](int i, int columns, double x) {
    return btVector3(btScalar(x) + apart.x() * btScalar(i % columns), apart.y() * btScalar(i / columns), -lower.z());
  };
  for (int i = 0; i < kMoving; ++i)
    w.add(shape, 1, at(i, 10, -100) + btVector3(0, 0, btScalar(0.1))).setActivationState(DISABLE_DEACTIVATION);
  w.step(kSettling);
  const double before = bytesInUse();
  std::vector<btRigidBody*> lying;
  for (int i = 0; i < still; ++i) lying.push_back(&w.add(shape, 1, at(i, 100, 0)));
  w.step(kLying);
  for (btRigidBody* body : lying) body->forceActivationState(ISLAND_SLEEPING);
  const double awake = bytesInUse() - before;
  w.step(kResting);
  Cost cost;
  cost.bytesAwake = awake;
  cost.bytes = bytesInUse() - before;
  std::vector<double> times;
  for (int i = 0; i < kMeasured; ++i) {
    w.step();
    times.push_back(1e6 * w.dispatcher.seconds);
  }
  for (const btRigidBody* body : lying) cost.woken += body->isActive();
  cost.microseconds = median(times);
  cost.pairs = w.world.getPairCache()->getNumOverlappingPairs();
  return cost;
}

template <class Dispatcher>
void print(const char* name, const std::shared_ptr<btCollisionShape>& shape, const Options& options) {
  double alone = 0;
  for (const int still : options.still) {
    std::vector<Cost> costs;
    for (int run = 0; run < options.runs; ++run) costs.push_back(costOf<Dispatcher>(shape, still));
    std::vector<double> times;
    for (const Cost& cost : costs) times.push_back(cost.microseconds);
    const double time = median(times);
    if (still == 0) alone = time;
    fmt::print("{:<10} {:6} {:8} {:10.1f} {:10.4f} {:10.0f} {:10.0f}\n", name, still, costs[0].pairs, time,
               still > 0 ? (time - alone) / still : 0.0, still > 0 ? costs[0].bytesAwake / still : 0.0,
               still > 0 ? costs[0].bytes / still : 0.0);
    if (costs[0].woken > 0) fmt::print("  {} of them woke: these figures say nothing\n", costs[0].woken);
  }
}

int fail(const std::string& why) {
  fmt::print(stderr, "worlds_bench: {}\n", why);
  return 1;
}

int run(const Options& options) {
  std::shared_ptr<const SphereTree> tree = test::plainTree(test::ball(kRadius, 12), 4);
  if (!options.tree.empty()) {
    Result<SphereTree> loaded = loadTree(options.tree);
    if (!loaded) return fail(loaded.error().message);
    tree = std::make_shared<const SphereTree>(std::move(loaded).value());
  }
  fmt::print("shape       still    pairs    us/step   us/still bytes/awake bytes/still\n");
  print<bullet::Dispatcher<>>("tree", test::treeShape(tree), options);
  print<btCollisionDispatcher>("btSphere", std::make_shared<btSphereShape>(btScalar(kRadius)), options);
  return 0;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("What bodies that lie still cost beside a hundred that move.", "worlds_bench");
  cairn::bench::Options options;
  app.add_option("--tree", options.tree, "a .cairn file (default: a faceted ball)");
  app.add_option("--still", options.still, "bodies that lie still; several with commas, 0 first")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--runs", options.runs, "of each, whose median is told")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(options);
}
