// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/step_pairs.h"
#include "dispatch/step_plan.h"
#include "dispatch/step_rules.h"
#include "dispatch/step_tally.h"
#include "pairs/step_horizon.h"

class btCollisionDispatcher;

namespace cairn::bullet {

/// The step at hand, for all who work on it.
struct StepState {
  StepState(btCollisionDispatcher& ofBullet, StepEnd end) : dispatcher(ofBullet), rules(end) {}

  btCollisionDispatcher& dispatcher;
  StepRules rules;
  StepPairs pairs;
  StepPlan plan;
  Budget left = Budget::unlimited();
  StepTally tally;
  ContactScratch scratch;
  btScalar timeStep = 0, sweptTime = 0;  ///< seconds

  StepHorizon horizon() const {
    const bool asksTriangles = rules.asksTriangles();
    return {timeStep, sweptTime, asksTriangles ? timeStep : btScalar(0), asksTriangles};
  }
  /// What the plan may use.
  StepMeans means() const;
  /// Operations that pairs were resolved with lately, from their start.
  std::uint64_t usual() const { return static_cast<std::uint64_t>(usual_); }
  /// What a whole traversal took; 0: none ended.
  void learnUsual(std::uint64_t operations);
  /// Adds it to the tally; what was counted. `pair`: where it is seen.
  PairReport count(PairReport report, const ScheduledPair& pair);

  /// How an answer that is kept is measured. While budgets leave pairs unresolved, those that have an answer take turns
  /// in looking for what else came near.
  RefreshPolicy refreshPolicyOf(const TreePair& pair) const;
  void endStep();

 private:
  double usual_ = 300;
  bool wasScarce_ = false;   // the last step left pairs unresolved
  std::uint64_t steps_ = 0;  // so far
};

}  // namespace cairn::bullet
