// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "accuracy_cost/experiments/experiment.h"
#include "scenes/converge/converge.h"
#include "scenes/heap/heap_recording.h"

namespace cairn::accuracy_cost {

/// The extent of the measurement.
struct ContestExtent {
  scenes::ConvergeOptions converge;
  scenes::HeapRecordingOptions heap;
  std::uint32_t truthEvery = 10;  ///< the exact check judges every frame with this step, from the first on
  std::uint32_t repetitions = 7;  ///< of all shapes in turn
  unsigned depth = 3;             ///< levels of the finest tree
  bool isFine = false;            ///< more trees, more budgets
};

/// Measures the error and the cost of each shape on the same recorded poses: error against microseconds.
Experiment errorAgainstTimeExperiment();

/// Measures with a given extent. Fails with `kCancelled`, and for a model that is not suitable. All columns except
/// those of time have the same bits every time. Names of time columns end in `_us` or begin with `time_`.
Result<Table> measureErrorAgainstTime(const std::vector<Model>& models, const ContestExtent& extent, std::uint64_t seed,
                                      const builder::ProgressCallback& progress);

}  // namespace cairn::accuracy_cost
