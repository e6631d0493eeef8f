// SPDX-License-Identifier: Zlib
#include "dispatch/step_state.h"

#include "dispatch/step_tuning.h"

namespace cairn::bullet {

StepMeans StepState::means() const {
  constexpr std::uint64_t kUnbounded = Budget::kUnlimited / 2;
  StepMeans means;
  if (left.remaining() < kUnbounded) means.operations = static_cast<double>(left.remaining());
  means.nanoseconds = left.nanosecondsFree();
  return means;
}

void StepState::learnUsual(std::uint64_t operations) {
  if (operations > 0) usual_ += step_tuning::kLearning * (static_cast<double>(operations) - usual_);
}

RefreshPolicy StepState::refreshPolicyOf(const TreePair& pair) const {
  if (plan.isScarce()) return RefreshPolicy::allIfFew;
  const bool isThrifty =
      wasScarce_ && rules.mayBeInterrupted() && (pair.notes.id + steps_) % step_tuning::kStepsOfThrift != 0;
  return isThrifty ? RefreshPolicy::touching : RefreshPolicy::all;
}

void StepState::endStep() {
  wasScarce_ = tally.statistics.unresolvedPairs > 0;
  ++steps_;
}

void StepState::count(TreePair& pair, PairReport report, const ScheduledPair& seen) {
  const auto size = static_cast<double>(seen.size);
  if (const std::optional<Viewer>& viewer = rules.viewer())
    report.seenError = seenError(sightOf(*viewer, seen.center, size / 2), report.errorFraction * size);
  tally.add(report);
  if (pair.is(PairStage::idle)) return;  // destroyed
  pair.notes.lastReport = report;
  pair.notes.isReported = true;
}

}  // namespace cairn::bullet
