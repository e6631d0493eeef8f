// SPDX-License-Identifier: Zlib
// No pair starves under any priority: a waiting pair has its turn within two turns for each pair that waits with it,
// itself included, counted over steps, whatever the ranks and however many pairs come and go.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <string>

#include "cairn/core/ranked_priority.h"
#include "priorities.h"
#include "random_tree.h"
#include "scripted_traversal.h"

namespace cairn::test::fairness_test {
namespace {

/// Pairs of all ranks that come, finish, begin again and go, and how long each has waited, in turns.
class Traffic {
 public:
  /// `countsAll`: a wait is measured against all pairs there are instead of those that wait.
  Traffic(std::uint64_t seed, bool countsAll) : engine_(seed), countsAll_(countsAll) {}

  void comeAndGo() {
    if (inUse_.size() > 2 && engine_() % 8 == 0) inUse_.erase(std::next(inUse_.begin(), pick(inUse_.size())));
    if (inUse_.size() < 40 && engine_() % 2 == 0) {
      const int id = nextId_++;
      std::vector<float> errors;
      for (std::uint64_t i = 0, count = 1 + engine_() % 30; i < count; ++i)
        errors.push_back(static_cast<float>(std::exp(uniform(engine_, -20, 5))));
      inUse_.emplace(id, Waiting{ScriptedTraversal(id, std::move(errors), log), 0, 0});
    }
    for (auto& [id, w] : inUse_)
      if (w.traversal.done() && engine_() % 2 == 0) w.traversal.restart(), w.turns = 0, w.bound = 0;
    waiting_ = 0;
    for (auto& [id, w] : inUse_) waiting_ += w.traversal.done() && !countsAll_ ? 0 : 1;
  }

  std::vector<ScheduledPair> pairs() {
    std::vector<ScheduledPair> list;
    for (auto& [id, w] : inUse_) {
      if (!w.traversal.done() && w.bound == 0) w.bound = RankedPriority::kTurnsToLine * waiting_;
      list.push_back({.id = static_cast<std::uint64_t>(id),
                      .traversal = &w.traversal,
                      .center = randomPoint(engine_) * 10.0,
                      .size = static_cast<float>(uniform(engine_, 0.01, 10)),
                      .closingSpeed = static_cast<float>(uniform(engine_, 0, 20)),
                      .mass = static_cast<float>(uniform(engine_, 0, 5)),
                      .unansweredError = engine_() % 3 == 0 ? 1.0F : 0.0F});
    }
    return list;
  }

  /// Reads the log of a step; returns the longest wait as a fraction of what is allowed.
  double longestWait() {
    double longest = 0;
    for (const int served : log)
      for (auto& [id, w] : inUse_) {
        if (w.bound == 0) continue;  // had nothing to wait for when the step began
        ++w.turns;
        longest = std::max(longest, static_cast<double>(w.turns) / static_cast<double>(w.bound));
        if (id == served) w.turns = 0, w.bound = w.traversal.done() ? 0 : RankedPriority::kTurnsToLine * waiting_;
      }
    log.clear();
    return longest;
  }

  std::vector<int> log;
  std::mt19937_64& engine() { return engine_; }

 private:
  struct Waiting {
    ScriptedTraversal traversal;
    std::uint64_t turns, bound;  // turns gone by since its last, and how many may; 0: it does not wait
  };
  std::ptrdiff_t pick(std::size_t count) { return static_cast<std::ptrdiff_t>(engine_() % count); }

  std::mt19937_64 engine_;
  bool countsAll_;
  std::map<int, Waiting> inUse_;
  std::uint64_t waiting_ = 0;
  int nextId_ = 1;
};

class Fairness : public testing::TestWithParam<std::string> {};

// RapidCheck prints the seed when it fails.
TEST_P(Fairness, NoPairStarves) {
  double longest = 0;
  const bool holds = rc::check("a pair is served within two turns for each that waits", [&](std::uint64_t seed) {
    // Round-robin remembers its turns of pairs that have long been done: they come back to where they stood in line.
    Traffic traffic(seed, GetParam() == "RoundRobin");
    const auto priority = makePriority(GetParam());
    if (seed % 2 == 0) priority->setViewer(Viewer{});
    for (int step = 0; step < 400; ++step) {
      traffic.comeAndGo();
      std::vector<ScheduledPair> pairs = traffic.pairs();
      Budget budget = Budget::operations(Scheduler::kTurnOperations * (1 + traffic.engine()() % 3));
      (void)Scheduler().run(pairs, *priority, budget);
      longest = std::max(longest, traffic.longestWait());
      RC_ASSERT(longest <= 1);
    }
  });
  EXPECT_TRUE(holds);
  std::cout << GetParam() << ": the longest wait was " << static_cast<int>(100 * longest)
            << " % of the bound, two turns for each waiting pair\n";
}

TEST_P(Fairness, SameCalls_GiveTheSameTurns) {
  const auto turns = [&](std::uint64_t shuffle) {
    Traffic traffic(7, false);
    std::mt19937_64 engine(shuffle);
    const auto priority = makePriority(GetParam());
    priority->setViewer(Viewer{});
    std::vector<int> all;
    for (int step = 0; step < 200; ++step) {
      traffic.comeAndGo();
      std::vector<ScheduledPair> pairs = traffic.pairs();
      std::shuffle(pairs.begin(), pairs.end(), engine);
      Budget budget = Budget::operations(Scheduler::kTurnOperations * 5);
      (void)Scheduler().run(pairs, *priority, budget);
      all.insert(all.end(), traffic.log.begin(), traffic.log.end());
      (void)traffic.longestWait();
    }
    return all;
  };
  EXPECT_GT(turns(1).size(), 500U);
  EXPECT_EQ(turns(1), turns(1));
  EXPECT_EQ(turns(1), turns(2)) << "the order in which pairs are handed over does not matter";
}

INSTANTIATE_TEST_SUITE_P(Priorities, Fairness, testing::ValuesIn(kPriorities),
                         [](const auto& policy) { return policy.param; });

}  // namespace
}  // namespace cairn::test::fairness_test
