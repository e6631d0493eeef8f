// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "accuracy_cost/experiments/experiment.h"

namespace cairn::accuracy_cost {

/// The extent of the measurement.
struct FrameTimeExtent {
  std::uint32_t heapBodies = 100, crushBodies = 20;
  std::uint32_t steps = 600;      ///< per run
  std::uint32_t repetitions = 6;  ///< of each run, shape by shape in turn
  double heapBudgetUs = 1000, crushBudgetUs = 500;
  unsigned depth = 3;  ///< levels of the tree
};

/// Measures the narrow phase's time step by step: Cairn on a budget of microseconds beside Bullet's own shapes.
Experiment frameTimeExperiment();

/// Measures with a given extent. Fails with `kCancelled`, and for a model that is not suitable.
Result<Table> measureFrameTime(const std::vector<Model>& models, const FrameTimeExtent& extent, std::uint64_t seed,
                               const builder::ProgressCallback& progress);

std::vector<Claim> judgeFrameTime(const Table& table);

}  // namespace cairn::accuracy_cost
