// SPDX-License-Identifier: Zlib
#pragma once

#include "dispatch/step_pairs.h"
#include "dispatch/step_plan.h"
#include "dispatch/step_rules.h"
#include "dispatch/step_tally.h"
#include "pairs/step_horizon.h"

class btCollisionDispatcher;

namespace cairn::bullet {

/// The present step, shared by all parts that work on it.
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
  /// What the plan may spend.
  StepMeans means() const;
  /// Recent operations per complete traversal.
  std::uint64_t usual() const { return static_cast<std::uint64_t>(usual_); }
  /// Reports the operations of a complete traversal; 0 if none ended.
  void learnUsual(std::uint64_t operations);
  /// Adds a pair's report to the tally and notes it. `seen`: how a viewer sees the pair. A callback may have destroyed
  /// the pair meanwhile.
  void count(TreePair& pair, PairReport report, const ScheduledPair& seen);

  /// Which leaf pairs of a cached answer are measured again. While budgets leave pairs unresolved, pairs with an answer
  /// take turns in measuring all.
  RefreshPolicy refreshPolicyOf(const TreePair& pair) const;
  void endStep();

 private:
  double usual_ = 300;
  bool wasScarce_ = false;   // the last step left pairs unresolved
  std::uint64_t steps_ = 0;  // so far
};

}  // namespace cairn::bullet
