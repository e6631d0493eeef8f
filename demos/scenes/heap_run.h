// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/heap.h"
#include "scenes/interpenetration.h"
#include "scenes/quantiles.h"

namespace cairn::scenes {

/// What only the sphere-tree narrow phase can say of itself, over all steps.
struct TreeRunStatistics {
  Quantiles operations;               ///< of Eq. 2.1, a step
  double meanErrorFraction = 0;       ///< certified, mean over the steps with contacts
  double maxErrorFraction = 0;        ///< certified, worst pair of any step
  double meanSeenError = 0;           ///< of a watched heap, radians: mean over the steps with contacts
  double maxSeenError = 0;            ///< of a watched heap, radians: worst pair of any step
  double unresolvedPairFraction = 0;  ///< of all pairs of all steps
};

struct HeapReport {
  std::uint32_t steps = 0;
  Quantiles narrowPhaseCpuUs, stepCpuUs, contacts, manifolds;  ///< a step
  std::optional<TreeRunStatistics> tree;
  Interpenetration end;
  double peakSpeed = 0;         ///< m/s, any body at the end of any step
  double kineticEnergyEnd = 0;  ///< J/kg, mean over bodies
  std::uint32_t lost = 0, asleep = 0;
  std::vector<StepRecord> records;  ///< one a step
  std::string stateHash;            ///< over poses and velocities after every `kHashInterval` steps and at the end
};

inline constexpr std::uint32_t kHashInterval = 60;

/// Told after each step how many are done; returns false to stop the run.
using StepCallback = std::function<bool(std::uint32_t done)>;

/// Runs a heap and judges how it ends. Fails with `builder::kCancelled` if `afterStep` stops it, and if the mesh is not
/// closed.
Result<HeapReport> runHeap(Heap& heap, std::uint32_t steps, const StepCallback& afterStep = {});

}  // namespace cairn::scenes
