// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dispatch/step_state.h"
#include "dispatch/workers.h"
#include "pairs/pair_measure.h"
#include "pairs/pair_reuse.h"

namespace cairn::bullet {

/// Makes the contacts of a step's pairs. Threads of Bullet's task scheduler measure contacts. The calling thread writes
/// the manifolds and calls users' callbacks, in an order that depends on the pairs alone. The result has the same bits
/// for any number of threads.
class StepAnswers {
 public:
  explicit StepAnswers(StepState& step) : step_(step) {}

  // Precondition of all functions: the pairs are in order, and the end of the step is announced.

  /// Answers all pairs from the beginning, without a budget.
  void answerAll();
  /// `answerBegun` answers the pairs that were added since `clear`, within a budget of operations. Each pair may use
  /// its reservation. Meshes are asked while the rest of the budget lasts, leaves otherwise. Precondition: the pairs
  /// are begun.
  void clear() { works_.clear(); }
  void add(std::size_t pair) { works_.emplace_back().pair = pair; }
  void answerBegun();

 private:
  enum class Outcome : std::uint8_t { none, reused, measured };

  struct Work {
    std::size_t pair = 0;
    Outcome outcome = Outcome::none;
    bool asksMeshes = true;                    // its share includes meshes
    std::uint64_t share = Budget::kUnlimited;  // operations that it may use
    std::uint64_t operations = 0;              // operations that it used
    Unmoved still{};                           // of a reused pair
    PairAnswer answer;
  };

  // A pair's report, and how a viewer sees it.
  struct Reported {
    PairReport report;
    ScheduledPair seen;
  };

  void takeRules();
  std::size_t shareOut();
  std::optional<std::uint64_t> meshCostOf(const Work& work) const;
  void run(std::size_t first, std::size_t last);
  void runTogether(std::span<Work> works);
  bool asksForUsersCode(const TreePair& pair) const;
  void work(Work& work, ContactScratch& scratch) const;
  void measure(Work& work, ContactScratch& scratch) const;
  void write(Work& work);
  Reported tell(TreePair& pair, const Work& work);

  StepState& step_;
  Workers workers_;
  std::vector<Work> works_;
  AnswerPolicy policy_;  // of this step: callbacks may ask for another
  bool areNew_ = true;   // nothing was done for the pairs in this step before
};

}  // namespace cairn::bullet
