// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"
#include "scenes/converge/converge.h"
#include "scenes/heap/heap_recording.h"

namespace cairn::accuracy_cost {

/// How much is measured.
struct ContestExtent {
  scenes::ConvergeOptions converge;
  scenes::HeapRecordingOptions heap;
  std::uint32_t truthEvery = 10;  ///< frames from one the exact check judges to the next
  std::uint32_t repetitions = 7;  ///< of all shapes in turn
  unsigned depth = 3;             ///< levels of the finest tree
  bool isFine = false;            ///< more trees, more budgets
};

/// What each shape errs and costs on the same recorded poses: error against microseconds.
Experiment errorAgainstTimeExperiment();

/// The same on an extent of one's own. Fails with `kCancelled`, and for a model it cannot be made with. Columns but
/// those of time (their names end in `_us` or begin with `time_`) are the same bits every time.
Result<Table> measureErrorAgainstTime(const std::vector<Model>& models, const ContestExtent& extent, std::uint64_t seed,
                                      const builder::ProgressCallback& progress);

}  // namespace cairn::accuracy_cost
