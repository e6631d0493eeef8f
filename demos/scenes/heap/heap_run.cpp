// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap_run.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/progress.h"

namespace cairn::scenes {
namespace {

/// A second, to see what the bodies cost before the budget held.
constexpr std::size_t kBefore = 60;

BudgetCut::Part partOf(std::span<const StepRecord> records) {
  BudgetCut::Part part;
  std::vector<double> operations;
  for (const StepRecord& record : records) {
    if (!record.tree) continue;
    operations.push_back(static_cast<double>(record.tree->operations));
    part.worstErrorFraction = std::max(part.worstErrorFraction, record.tree->worstErrorFraction);
  }
  part.operations = quantilesOf(std::move(operations)).median;
  return part;
}

std::optional<BudgetCut> budgetCut(std::span<const StepRecord> records, std::size_t without) {
  if (without == 0 || without >= records.size() || !records[0].tree) return {};
  const std::size_t before = std::min(without, kBefore);
  return BudgetCut{partOf(records.subspan(without - before, before)), partOf(records.subspan(without))};
}

}  // namespace

Result<HeapReport> runHeap(Heap& heap, std::uint32_t steps, const StepCallback& afterStep) {
  HeapReport report;
  report.steps = steps;
  std::vector<StepRecord> records;
  StateHash hash;
  for (std::uint32_t done = 1; done <= steps; ++done) {
    if (done == heap.stepsWithoutBudget() + 1 && done > 1)
      if (const Status status = heap.beginBudget(); !status) return status.error();
    records.push_back(heap.step());
    report.peakSpeed = std::max(report.peakSpeed, fastestSpeed(heap.world().bodies()));
    if (done % kHashInterval == 0 || done == steps) heap.world().addState(hash);
    if (afterStep && !afterStep(done)) return Error{std::string(builder::kCancelled)};
  }
  const auto interpenetration = measureInterpenetration(heap);
  if (!interpenetration) return interpenetration.error();

  report.cost = runCost(records);
  report.cut = budgetCut(records, heap.stepsWithoutBudget());
  report.end = interpenetration.value();
  report.kineticEnergyEnd = meanKineticEnergy(heap.world().bodies());
  report.lost = heap.countLost();
  report.asleep = countAsleep(heap.world().bodies());
  report.stateHash = hash.hex();
  report.records = std::move(records);
  return report;
}

}  // namespace cairn::scenes
