// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/run_cost.h"

#include <algorithm>
#include <utility>

namespace cairn::scenes {
namespace {

Quantiles quantilesOver(const std::vector<StepRecord>& records, double (*value)(const StepRecord&)) {
  std::vector<double> sample;
  for (const StepRecord& record : records) sample.push_back(value(record));
  return quantilesOf(std::move(sample));
}

std::optional<TreeRunStatistics> treeStatistics(const std::vector<StepRecord>& records) {
  if (records.empty() || !records.front().tree) return {};
  TreeRunStatistics statistics;
  std::uint64_t pairs = 0, unresolved = 0, contacts = 0, exact = 0, stepsWithContacts = 0;
  for (const StepRecord& record : records) {
    const bullet::StepStatistics& step = *record.tree;
    pairs += step.pairs;
    unresolved += step.unresolvedPairs;
    contacts += step.contacts;
    exact += step.exactContacts;
    statistics.maxErrorFraction = std::max(statistics.maxErrorFraction, step.worstErrorFraction);
    statistics.maxSeenError = std::max(statistics.maxSeenError, step.worstSeenError);
    if (step.contacts == 0) continue;
    statistics.meanErrorFraction += step.meanErrorFraction;
    statistics.meanSeenError += step.meanSeenError;
    ++stepsWithContacts;
  }
  if (stepsWithContacts > 0) {
    statistics.meanErrorFraction /= static_cast<double>(stepsWithContacts);
    statistics.meanSeenError /= static_cast<double>(stepsWithContacts);
  }
  if (pairs > 0) statistics.unresolvedPairFraction = static_cast<double>(unresolved) / static_cast<double>(pairs);
  if (contacts > 0) statistics.exactContactFraction = static_cast<double>(exact) / static_cast<double>(contacts);
  statistics.operations =
      quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.tree->operations); });
  return statistics;
}

std::optional<DeadlineKept> deadlineKept(const std::vector<StepRecord>& records) {
  const auto hasDeadline = [](const StepRecord& r) { return r.tree && r.tree->deadlineMicroseconds; };
  if (!std::ranges::any_of(records, hasDeadline)) return {};
  DeadlineKept kept;
  kept.elapsedUs = quantilesOver(records, [](const StepRecord& r) { return r.tree->elapsedMicroseconds; });
  for (const StepRecord& record : records) {
    const bullet::StepStatistics& step = *record.tree;
    kept.lateSteps += step.missedByMicroseconds > 0 ? 1 : 0;
    if (step.missedByMicroseconds <= kept.worstMissUs) continue;
    kept.worstMissUs = step.missedByMicroseconds;
    kept.worstMissOffCpuUs = std::max(step.elapsedMicroseconds - step.microseconds, 0.0);
  }
  return kept;
}

}  // namespace

RunCost runCost(const std::vector<StepRecord>& records) {
  RunCost cost;
  cost.narrowPhaseCpuUs = quantilesOver(records, [](const StepRecord& r) { return r.narrowPhaseCpuUs; });
  cost.stepCpuUs = quantilesOver(records, [](const StepRecord& r) { return r.stepCpuUs; });
  cost.contacts = quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.contacts); });
  cost.manifolds = quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.manifolds); });
  cost.tree = treeStatistics(records);
  cost.deadline = deadlineKept(records);
  return cost;
}

}  // namespace cairn::scenes
