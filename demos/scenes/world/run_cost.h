// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "scenes/figures/quantiles.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// Statistics of the sphere-tree narrow phase over all steps; other shapes have none.
struct TreeRunStatistics {
  Quantiles operations;               ///< of Eq. 2.1, per step
  double meanErrorFraction = 0;       ///< certified, mean over the steps with contacts
  double maxErrorFraction = 0;        ///< certified, worst pair of any step
  double meanSeenError = 0;           ///< radians, for a watched scene: mean over the steps with contacts
  double maxSeenError = 0;            ///< radians, for a watched scene: worst pair of any step
  double unresolvedPairFraction = 0;  ///< share of all pairs of all steps
  double exactContactFraction = 0;    ///< share of all contacts of all steps: measured between source triangles
};

/// The steps of a run against their deadline, in elapsed time.
struct DeadlineKept {
  Quantiles elapsedUs;          ///< per step
  std::uint64_t lateSteps = 0;  ///< steps that took longer than their deadline
  double worstMissUs = 0;
  double worstMissOffCpuUs =
      0;  ///< of the step with the worst miss: time in which the operating system ran other programs
};

/// The cost of a run's collision detection, over its steps.
struct RunCost {
  Quantiles narrowPhaseCpuUs, stepCpuUs, contacts, manifolds;  ///< per step
  std::optional<TreeRunStatistics> tree;                       ///< nothing for other shapes
  std::optional<DeadlineKept> deadline;                        ///< nothing where no step has one
};

RunCost runCost(const std::vector<StepRecord>& records);

}  // namespace cairn::scenes
