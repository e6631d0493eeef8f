// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/non_finite_pairs.h"
#include "dispatch/open_step.h"
#include "dispatch/step_refinement.h"

namespace cairn::bullet {

/// The narrow phase on a dispatcher that does not announce steps. Expected pairs are refined together when the first
/// pair of a step comes, and each pair is answered when it comes.
class OpenStepAnswers {
 public:
  OpenStepAnswers(StepState& step, StepRefinement& refinement, StepCarryOver& carryOver, NonFinitePairs& nonFinite)
      : step_(step), refinement_(refinement), carryOver_(carryOver), nonFinite_(nonFinite) {}

  /// Answers a pair. False, and nothing done, for pairs that are nested too deep for a copy.
  bool answer(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
              btManifoldResult& result);
  /// The next pair begins a new step in any case.
  void endStep();
  /// The pair is destroyed.
  void forget(TreePair& pair) { steps_.forget(pair); }
  /// Statistics of the last step. Valid until the next call.
  const StepStatistics& lastStep();

 private:
  void beginStep();
  std::size_t cullExpected();
  void refineExpected(double reserve);
  void dropUnanswered();
  bool cull(TreePair& pair, bool wasExpected);
  bool refineNewcomer(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  void withdraw(TreePair& pair);
  void tell(TreePair& pair, btManifoldResult& result);
  StepTally withOutstanding() const;
  void bookRefinement(const Budget& used, Budget::Clock::time_point began);
  void book(const Budget& used, Budget::Clock::time_point began);

  StepState& step_;
  StepRefinement& refinement_;
  StepCarryOver& carryOver_;
  NonFinitePairs& nonFinite_;
  OpenStep steps_;
  StepTally reported_;    // as last returned
  StepBudget left_;       // for refinement in this step, triangles included
  Reservation heldBack_;  // part of it, for the contacts of pairs that have not come yet, and for unexpected pairs
};

}  // namespace cairn::bullet
