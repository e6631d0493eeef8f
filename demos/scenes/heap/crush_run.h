// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/heap/crush_start.h"
#include "scenes/heap/heap.h"
#include "scenes/heap/heap_run.h"

namespace cairn::scenes {

/// How a crushed heap came apart. Depths are fractions of body size.
struct CrushCourse {
  double emptyStepCpuUs = 0;                ///< see `measureEmptyStep`
  std::optional<double> bareDeadlineCpuUs;  ///< 99.9 % of `bareDeadline`, where the budget is in microseconds
  std::vector<double> worstPenetration;     ///< of the meshes: at the start and after every `kCourseInterval` steps
  /// Seconds from which on the worst penetration stayed below `kResolvedFraction`; nothing if it is not at the end.
  std::optional<double> resolvedAfter;
};

inline constexpr std::uint32_t kCourseInterval = 15;  ///< steps: a quarter of a second
inline constexpr double kResolvedFraction = 0.03;

/// Runs a scene that stands as it started and adds to `course` how it came apart. The poses to be judged are kept and
/// judged at the end: the check must not cool the caches of what is timed. Fails as `runHeap` does.
Result<HeapReport> runCrush(BodyScene& scene, std::uint32_t steps, CrushCourse& course,
                            const StepCallback& afterStep = {});

/// Median CPU time, us, of the narrow phase when there is nothing to do: the bodies of `options.start` in the same pit,
/// but weightless and far from each other and from the pit, with a budget of zero operations.
Result<double> measureEmptyStep(const Model& model, const HeapOptions& options);

}  // namespace cairn::scenes
