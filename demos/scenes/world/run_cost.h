// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "scenes/figures/quantiles.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// What only the sphere-tree narrow phase can say of itself, over all steps.
struct TreeRunStatistics {
  Quantiles operations;               ///< of Eq. 2.1, a step
  double meanErrorFraction = 0;       ///< certified, mean over the steps with contacts
  double maxErrorFraction = 0;        ///< certified, worst pair of any step
  double meanSeenError = 0;           ///< of a watched scene, radians: mean over the steps with contacts
  double maxSeenError = 0;            ///< of a watched scene, radians: worst pair of any step
  double unresolvedPairFraction = 0;  ///< of all pairs of all steps
  double exactContactFraction = 0;    ///< of all contacts of all steps: measured between source triangles
};

/// How the steps of a run kept their deadline, in elapsed time.
struct DeadlineKept {
  Quantiles elapsedUs;          ///< a step
  std::uint64_t lateSteps = 0;  ///< that took longer than their deadline
  double worstMissUs = 0;
  double worstMissOffCpuUs = 0;  ///< of the step that missed it by most: while the operating system ran others
};

/// What the collision of a run cost, over its steps.
struct RunCost {
  Quantiles narrowPhaseCpuUs, stepCpuUs, contacts, manifolds;  ///< a step
  std::optional<TreeRunStatistics> tree;                       ///< nothing for other shapes
  std::optional<DeadlineKept> deadline;                        ///< nothing where no step has one
};

RunCost runCost(const std::vector<StepRecord>& records);

}  // namespace cairn::scenes
