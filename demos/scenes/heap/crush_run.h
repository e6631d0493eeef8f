// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/heap/crush_start.h"
#include "scenes/heap/heap.h"
#include "scenes/heap/heap_run.h"

namespace cairn::scenes {

/// The separation of a crushed heap over time. Depths are fractions of body size.
struct CrushCourse {
  double emptyStepCpuUs = 0;                ///< see `measureEmptyStep`
  std::optional<double> bareDeadlineCpuUs;  ///< 99.9 % quantile of `bareDeadline`, for a budget in microseconds
  std::vector<double> worstPenetration;     ///< of the meshes: at the start and after every `kCourseInterval` steps
  /// Seconds after which the worst penetration stays below `kResolvedFraction`; nothing if it is not below at the end.
  std::optional<double> resolvedAfter;
};

inline constexpr std::uint32_t kCourseInterval = 15;  ///< steps: a quarter of a second
inline constexpr double kResolvedFraction = 0.03;

/// Runs a scene from its start poses and records the separation in `course`. Poses are stored and judged at the end,
/// because the check must not disturb the caches of timed code. Fails as `runHeap` does.
Result<HeapReport> runCrush(BodyScene& scene, std::uint32_t steps, CrushCourse& course,
                            const StepCallback& afterStep = {});

/// Returns the median CPU time (us) of the narrow phase without any work. The bodies of `options.start` are in the same
/// pit, but weightless and far from each other and from the pit. The budget is zero operations.
Result<double> measureEmptyStep(const Model& model, const HeapOptions& options);

}  // namespace cairn::scenes
