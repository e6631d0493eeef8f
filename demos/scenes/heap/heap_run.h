// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/heap/interpenetration.h"
#include "scenes/world/body_scene.h"
#include "scenes/world/run_cost.h"

namespace cairn::scenes {

/// The effect of a budget that applies from some step on.
struct BudgetCut {
  struct Part {
    double operations = 0;          ///< per step, median
    double worstErrorFraction = 0;  ///< certified, worst pair of any step
  };
  Part before;  ///< the last second without the budget
  Part after;   ///< all steps with it
};

struct HeapReport {
  std::uint32_t steps = 0;
  RunCost cost;
  std::optional<BudgetCut> cut;  ///< nothing when the budget applies from the beginning
  Interpenetration end;
  double peakSpeed = 0;         ///< m/s, any body at the end of any step
  double kineticEnergyEnd = 0;  ///< J/kg, mean over bodies
  /// Jitter of the bodies, m/s: the change of a body's velocity from step to step. It is the root mean square over all
  /// bodies and the steps of the last second. A step of free fall at 1/60 s changes 0.16 m/s.
  double jitter = 0;
  std::uint32_t lost = 0, asleep = 0;
  std::vector<Vec3d> placesAfterASecond,
      placesAtTheEnd;               ///< of the bodies' centres; a shorter run has the latter twice
  std::vector<StepRecord> records;  ///< one a step
  std::string stateHash;            ///< over poses and velocities after every `kHashInterval` steps and at the end
};

inline constexpr std::uint32_t kHashInterval = 60;

/// Called after each step with the number of finished steps; returns false to stop the run.
using StepCallback = std::function<bool(std::uint32_t done)>;

/// Runs a scene and judges its end state. Fails with `builder::kCancelled` if `afterStep` stops it, and if the mesh is
/// not closed.
Result<HeapReport> runHeap(BodyScene& scene, std::uint32_t steps, const StepCallback& afterStep = {});

}  // namespace cairn::scenes
