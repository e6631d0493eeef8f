// SPDX-License-Identifier: Zlib
//
// The certified error of interrupted traversals: many pairs of one tree in random poses, refined in turn,
// the worst first, and in the best order there is, at some parts of the operations that all of it takes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "best_order.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/round_robin.h"
#include "cairn/core/scheduler.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/worst_error_first.h"
#include "random_tree.h"
#include "test_trees.h"

namespace cairn::bench {
namespace {

using test::PlacedPair;

constexpr const char* kGenerated = "a generated ring";

struct Options {
  std::string tree = kGenerated, json;
  std::size_t pairs = 150;
  double depthPercent = 0.5;
  std::uint64_t seed = 1;
};

constexpr float kReachFraction = 0.002F;  // of the size, as contacts are looked for

class Pairs {
 public:
  Pairs(const SphereTree& tree, const Options& options)
      : size_(2 * double(tree.sphere(kRootNode).radius)), margin_(kReachFraction * static_cast<float>(size_)) {
    std::mt19937_64 engine(options.seed);
    for (std::size_t k = 0; k < options.pairs; ++k) {
      PlacedPair pair{&tree, &tree, turned(engine), turned(engine), size_};
      push(pair, turned(engine).rotation * Vec3d(1, 0, 0), options.depthPercent / 100 * size_);
      pairs_.push_back(pair);
    }
    traversals_.resize(pairs_.size());
  }

  /// Operations used.
  std::uint64_t refine(Priority& priority, Budget budget) {
    std::vector<ScheduledPair> scheduled;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      start(traversals_[k], pairs_[k], margin_);
      scheduled.push_back({.id = k, .traversal = &traversals_[k], .size = static_cast<float>(size_)});
    }
    (void)Scheduler().run(scheduled, priority, budget);
    return budget.used();
  }
  double worst() const {
    double worst = 0;
    for (const TreePairTraversal& traversal : traversals_) worst = std::max(worst, double(traversal.worstError()));
    return worst / size_;
  }
  double worstInBestOrder(std::uint64_t operations) const {
    return test::BestOrder(pairs_, margin_).worstAfter(operations);
  }

 private:
  static Pose turned(std::mt19937_64& engine) { return {test::randomRotation(engine), {}, 1}; }
  static void start(TreePairTraversal& traversal, const PlacedPair& pair, float margin) {
    traversal.start(*pair.a, *pair.b, pair.poseA, pair.poseB, margin);
  }
  // Moves the second along the direction until leaves meet for the last time, and back by the depth.
  void push(PlacedPair& pair, const Vec3d& along, double depth) const {
    constexpr int kHalvings = 40;
    double meets = 0, apart = 2 * size_;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (meets + apart) / 2;
      pair.poseB.translation = along * middle;
      TreePairTraversal traversal;
      start(traversal, pair, 0);
      Budget budget = Budget::unlimited();
      (void)traversal.refine(budget);
      (traversal.leafPairs().empty() ? apart : meets) = middle;
    }
    pair.poseB.translation = along * (meets - depth);
  }

  double size_;
  float margin_;
  std::vector<PlacedPair> pairs_;
  std::vector<TreePairTraversal> traversals_;
};

Result<std::shared_ptr<const SphereTree>> treeOf(const Options& options) {
  if (options.tree == kGenerated) return test::plainTree(test::torus(0.4, 0.15, 32));
  Result<SphereTree> tree = loadTree(options.tree);
  if (!tree) return tree.error();
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

int run(const Options& options) {
  const auto tree = treeOf(options);
  if (!tree) {
    fmt::print(stderr, "interrupted_bench: {}\n", tree.error().message);
    return 1;
  }
  Pairs pairs(*tree.value(), options);
  RoundRobin inTurn;
  WorstErrorFirst worstFirst;
  const std::uint64_t all = pairs.refine(inTurn, Budget::unlimited());
  const double full = pairs.worst();
  fmt::print(
      "{} pairs of {}, {} % of the size deep; all of it: {} operations, worst certified error {:.2f} % of size\n\n",
      options.pairs, options.tree, options.depthPercent, all, 100 * full);
  fmt::print("worst error, times that      in turn   worst first   any order\n");
  nlohmann::ordered_json json{{"tree", options.tree}, {"pairs", options.pairs}, {"depth_percent", options.depthPercent},
                              {"seed", options.seed}, {"operations", all},      {"worst_error_fraction", full}};
  for (const unsigned percent : {5U, 10U, 25U, 50U, 75U}) {
    const std::uint64_t operations = all * percent / 100;
    (void)pairs.refine(inTurn, Budget::operations(operations));
    const double turns = pairs.worst() / full;
    (void)pairs.refine(worstFirst, Budget::operations(operations));
    const double worst = pairs.worst() / full, best = pairs.worstInBestOrder(operations) / full;
    fmt::print("  at {:2} % of the operations  {:8.2f}{:14.2f}{:12.2f}\n", percent, turns, worst, best);
    json["parts"].push_back(
        {{"percent", percent}, {"in_turn_ratio", turns}, {"worst_first_ratio", worst}, {"any_order_ratio", best}});
  }
  if (options.json.empty()) return 0;
  const Status written = writeFileAtomically(options.json, json.dump(2) + "\n");
  if (!written) fmt::print(stderr, "interrupted_bench: {}\n", written.error().message);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  CLI::App app("What certified error interrupted traversals are left with, in several orders and the best there is.",
               "interrupted_bench");
  cairn::bench::Options options;
  app.add_option("TREE", options.tree, "A .cairn file")->capture_default_str();
  app.add_option("--pairs", options.pairs, "Random poses")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--depth-percent", options.depthPercent, "By which the two overlap, of the size")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "Of the poses")->capture_default_str();
  app.add_option("--json", options.json, "Write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  return cairn::bench::run(options);
}
