// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/non_finite_pairs.h"
#include "dispatch/open_step.h"
#include "dispatch/step_refinement.h"

namespace cairn::bullet {

/// The narrow phase on a dispatcher that does not say where steps end: pairs are refined together when the first of a
/// step comes, and answered one by one as they come.
class OpenStepAnswers {
 public:
  OpenStepAnswers(StepState& step, StepRefinement& refinement, StepCarryOver& carryOver, NonFinitePairs& nonFinite)
      : step_(step), refinement_(refinement), carryOver_(carryOver), nonFinite_(nonFinite) {}

  /// False, and nothing done, for what is nested too deep to be remembered.
  bool answer(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
              btManifoldResult& result);
  /// The next pair begins a step, whatever it is.
  void endStep();
  /// It is destroyed.
  void forget(TreePair& pair) { steps_.forget(pair); }
  /// Valid until it is asked for again.
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
  StepTally reported_;    // what was last told
  StepBudget left_;       // for refinement in the step at hand, triangles included
  Reservation heldBack_;  // of it, for pairs that have still to come: their contacts, and newcomers
};

}  // namespace cairn::bullet
