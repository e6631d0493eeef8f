// SPDX-License-Identifier: GPL-3.0-or-later
#include "region_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "regions/drop_spheres.h"
#include "regions/lookahead.h"

namespace cairn::builder {

namespace {

/// Rounds of relief for each level, and the fraction of the level's worst error from which a node takes part. Only the
/// worst sphere decides the error of a level.
constexpr int kRootReliefRounds = 16, kReliefRounds = 6;
constexpr double kReliefShare = 0.95;
/// The root's division has the greatest influence and is only one, so it gets a thorough search.
constexpr int kRootSwapRounds = 6;

/// Counts finished regions and reports them from one thread at a time.
class LevelCounter {
 public:
  LevelCounter(const LevelProgress& progress, std::uint32_t level, std::size_t count)
      : progress_(progress), level_(level), count_(count) {}

  void finishOne() {
    const std::lock_guard lock(mutex_);
    if (!cancelled_ && !progress_(level_, ++done_, count_)) cancelled_ = true;
  }
  bool cancelled() {
    const std::lock_guard lock(mutex_);
    return cancelled_;
  }

 private:
  const LevelProgress& progress_;
  std::uint32_t level_;
  std::size_t count_;
  std::size_t done_ = 0;
  bool cancelled_ = false;
  std::mutex mutex_;
};

class Growth {
 public:
  Growth(const SignedDistance& solid, const SplitSettings& settings, const LevelProgress& progress)
      : solid_(solid), settings_(settings), progress_(progress) {}

  RegionTree run(Region root, std::uint32_t depth) {
    RegionTree tree;
    tree.push_back({std::move(root), 0, 0, 0});
    std::vector<Split> splits{splitRegion(tree[0].region, solid_, settings_, kRootSwapRounds)};
    if (settings_.optimiser == Optimiser::cairn)
      splits[0] = refineSplit(splits[0], tree[0].region, solid_, settings_, kRootSwapRounds);
    for (std::uint32_t level = 0; level < depth; ++level) {
      if (!dropAll(tree, splits, level)) return {};
      std::vector<Split> next;
      if (level + 1 < depth && !lookAhead(splits, next, level)) return {};
      append(tree, splits);
      splits = std::move(next);
    }
    return tree;
  }

 private:
  /// Drops spheres from the divisions of the tree's last nodes. False when cancelled.
  bool dropAll(const RegionTree& tree, std::vector<Split>& splits, std::uint32_t level) const {
    if (!settings_.balance) return true;
    // The divisions may still change in favour of their children, so the reported progress stays at the level's
    // beginning.
    const LevelProgress still = [&](std::uint32_t l, std::size_t, std::size_t count) { return progress_(l, 0, count); };
    LevelCounter counter(still, level, splits.size());
    const std::size_t first = tree.size() - splits.size();
    tbb::parallel_for(std::size_t{0}, splits.size(), [&](std::size_t i) {
      if (counter.cancelled()) return;
      splits[i] = dropSpheres(splits[i], tree[first + i].region, solid_, settings_);
      counter.finishOne();
    });
    return !counter.cancelled();
  }

  /// Divides the children of the level's nodes, then improves the level's divisions in their favour. False when
  /// cancelled.
  bool lookAhead(std::vector<Split>& splits, std::vector<Split>& next, std::uint32_t level) {
    std::vector<std::unique_ptr<Lookahead>> nodes(splits.size());
    LevelCounter counter(progress_, level, splits.size());
    tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
      if (counter.cancelled()) return;
      nodes[i] = std::make_unique<Lookahead>(std::move(splits[i]), solid_, settings_);
      counter.finishOne();
    });
    if (counter.cancelled()) return false;
    if (settings_.optimiser == Optimiser::cairn && !relieveAll(nodes, level)) return false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      splits[i] = nodes[i]->split();
      for (Split& split : nodes[i]->takeChildren()) next.push_back(std::move(split));
    }
    return true;
  }

  /// Relieves the worst nodes until the worst of all cannot be relieved further. The nodes of a round depend only on
  /// the results of the last one, not on the threads. False when cancelled.
  bool relieveAll(std::vector<std::unique_ptr<Lookahead>>& nodes, std::uint32_t level) const {
    double limit = 0;
    for (const auto& node : nodes) limit = std::max(limit, node->worstChild());
    const int rounds = nodes.size() == 1 ? kRootReliefRounds : kReliefRounds;
    for (int round = 0; round < rounds; ++round) {
      if (!progress_(level, nodes.size(), nodes.size())) return false;
      double worst = 0;
      for (const auto& node : nodes) worst = std::max(worst, node->worstGrandchild());
      std::vector<char> relieved(nodes.size(), 1);
      tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
        if (nodes[i]->worstGrandchild() >= kReliefShare * worst)
          relieved[i] = nodes[i]->relieve(limit, solid_, settings_) ? 1 : 0;
      });
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (relieved[i] == 0 && nodes[i]->worstGrandchild() == worst) return true;
    }
    return true;
  }

  /// Adds the children as nodes. `splits` belong to the last nodes of the tree, in order.
  static void append(RegionTree& tree, std::vector<Split>& splits) {
    const std::size_t first = tree.size() - splits.size();
    for (std::size_t i = 0; i < splits.size(); ++i) {
      tree[first + i].firstChild = static_cast<std::uint32_t>(tree.size());
      tree[first + i].childCount = static_cast<std::uint32_t>(splits[i].children.size());
      for (Region& child : splits[i].children)
        tree.push_back({std::move(child), static_cast<std::uint32_t>(first + i), 0, 0});
    }
  }

  const SignedDistance& solid_;
  const SplitSettings& settings_;
  const LevelProgress& progress_;
};

}  // namespace

RegionTree growRegionTree(Region root, std::uint32_t depth, const SignedDistance& solid, const SplitSettings& settings,
                          const LevelProgress& progress) {
  return Growth(solid, settings, progress).run(std::move(root), depth);
}

}  // namespace cairn::builder
