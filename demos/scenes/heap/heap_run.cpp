// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap_run.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/progress.h"

namespace cairn::scenes {
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

  report.cost = runCost(records);
  report.end = interpenetration.value();
  report.kineticEnergyEnd = meanKineticEnergy(heap.world().bodies());
  report.lost = heap.countLost();
  report.asleep = countAsleep(heap.world().bodies());
  report.stateHash = hash.hex();
  report.records = std::move(records);
  return report;
}

}  // namespace cairn::scenes
