// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap_run.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/progress.h"

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
  std::uint64_t pairs = 0, unresolved = 0, stepsWithContacts = 0;
  for (const StepRecord& record : records) {
    const bullet::StepStatistics& step = *record.tree;
    pairs += step.pairs;
    unresolved += step.unresolvedPairs;
    statistics.maxErrorFraction = std::max(statistics.maxErrorFraction, step.worstErrorFraction);
    statistics.maxSeenError = std::max(statistics.maxSeenError, step.worstSeenError);
    if (step.contacts == 0) continue;
    statistics.meanSeenError += step.meanSeenError;
    statistics.meanErrorFraction += step.meanErrorFraction;
    ++stepsWithContacts;
  }
  if (stepsWithContacts > 0) statistics.meanErrorFraction /= static_cast<double>(stepsWithContacts);
  if (stepsWithContacts > 0) statistics.meanSeenError /= static_cast<double>(stepsWithContacts);
  if (pairs > 0) statistics.unresolvedPairFraction = static_cast<double>(unresolved) / static_cast<double>(pairs);
  statistics.operations =
      quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.tree->operations); });
  return statistics;
}

}  // namespace

Result<HeapReport> runHeap(Heap& heap, std::uint32_t steps, const StepCallback& afterStep) {
  HeapReport report;
  report.steps = steps;
  std::vector<StepRecord> records;
  StateHash hash;
  for (std::uint32_t done = 1; done <= steps; ++done) {
    records.push_back(heap.step());
    report.peakSpeed = std::max(report.peakSpeed, fastestSpeed(heap.world().bodies()));
    if (done % kHashInterval == 0 || done == steps) heap.world().addState(hash);
    if (afterStep && !afterStep(done)) return Error{std::string(builder::kCancelled)};
  }
  const auto interpenetration = measureInterpenetration(heap);
  if (!interpenetration) return interpenetration.error();

  report.narrowPhaseCpuUs = quantilesOver(records, [](const StepRecord& r) { return r.narrowPhaseCpuUs; });
  report.stepCpuUs = quantilesOver(records, [](const StepRecord& r) { return r.stepCpuUs; });
  report.contacts = quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.contacts); });
  report.manifolds = quantilesOver(records, [](const StepRecord& r) { return static_cast<double>(r.manifolds); });
  report.tree = treeStatistics(records);
  report.end = interpenetration.value();
  report.kineticEnergyEnd = meanKineticEnergy(heap.world().bodies());
  report.lost = heap.countLost();
  report.asleep = countAsleep(heap.world().bodies());
  report.stateHash = hash.hex();
  report.records = std::move(records);
  return report;
}

}  // namespace cairn::scenes
