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

/// Makes the answers of a step's pairs. Contacts are measured on the threads of Bullet's task scheduler. The calling
/// thread brings the manifolds up to date, and calls the user's callbacks, in an order that depends on the pairs alone:
/// the same bits for any number of threads.
class StepAnswers {
 public:
  explicit StepAnswers(StepState& step) : step_(step) {}

  // Precondition of all: the pairs are in their order, and the step ends when it is told.

  /// Without a budget: from the beginning, of all there are.
  void answerAll();
  /// Of those that were added since it was cleared, within a budget of operations. Each may use what was promised to
  /// it; meshes are asked as long as the rest is enough for them, else leaves. Precondition: they are begun.
  void clear() { works_.clear(); }
  void add(std::size_t pair) { works_.emplace_back().pair = pair; }
  void answerBegun();

 private:
  enum class Outcome : std::uint8_t { none, reused, measured };

  struct Work {
    std::size_t pair = 0;
    Outcome outcome = Outcome::none;
    bool asksMeshes = true;                    // they are in its share
    std::uint64_t share = Budget::kUnlimited;  // operations it may use
    std::uint64_t operations = 0;              // it used
    Unmoved still{};                           // of what is carried over
    PairAnswer answer;
  };

  // What a pair told, and how it is seen.
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
  AnswerPolicy policy_;  // of the step at hand: callbacks may ask for others
  bool areNew_ = true;   // the pairs: nothing was done for them in this step before
};

}  // namespace cairn::bullet
