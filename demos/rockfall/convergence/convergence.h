// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rockfall/ensemble/compute_each.h"
#include "rockfall/ensemble/run_range.h"
#include "rockfall/simulation/run_result.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// What is compared of each rock.
inline constexpr std::array<const char*, 3> kConvergedNames{"run-out", "greatest speed", "greatest energy"};
inline constexpr std::size_t kRunout = 0;                            ///< its place among them
using ConvergedValues = std::array<double, kConvergedNames.size()>;  ///< m, m/s, J

struct ConvergenceOptions {
  RunRange runs;
  std::uint32_t halvings = 3;
  double tolerance = 0.03;  ///< of a quantity's mean at the finest step
  std::uint32_t jobs = 1;
};

/// What a step's rocks have less or more of a quantity than the same rocks at the finest step, as a part of its mean
/// there.
struct StepDifference {
  double mean = 0;
  double low = 0, high = 0;  ///< between which the mean is, 95 times in a hundred
};

enum class StepVerdict : std::uint8_t {
  fine,       ///< all intervals lie within the tolerance
  coarse,     ///< one lies outside it
  undecided,  ///< more runs would tell
  reference,  ///< the finest: what the others are measured by
};

struct ConvergenceStep {
  double stepS = 0;
  StepVerdict verdict = StepVerdict::reference;
  ConvergedValues means{};
  std::array<StepDifference, kConvergedNames.size()> differences{};
  /// About how many runs would tell; no fewer than there are. Only where undecided.
  std::uint64_t runsWanted = 0;
};

struct Convergence {
  std::vector<ConvergenceStep> steps;  ///< the coarsest first
  std::size_t rocks = 0, runs = 0;
  /// Rocks whose way was cut off, by the map's edge or the end of the time, at some step. Of too many, run-outs decide
  /// nothing.
  std::size_t cutOff = 0;
  bool judgesRunouts() const { return !areTooManyCutOff(cutOff, rocks); }
  /// The coarsest step which is fine, as are all between it and the finest.
  std::optional<double> fineStepS;
};

/// Fails for a case whose runs depend on the machine (microseconds as its budget), for fewer than
/// `kMinConvergenceRuns`, and for steps below what a case may have.
inline constexpr std::uint64_t kMinConvergenceRuns = 5;
Status checkConvergence(const Case& description, const ConvergenceOptions& options);

/// The same rocks at the case's step, at half of it, at a quarter, and so on. Pieces of rocks that break are left out.
/// Intervals come from drawing whole runs anew (bootstrap, by the case's seed): rocks of one run may meet. A pure
/// function of scene and options but for `jobs`. Fails as `checkConvergence` and `simulate` do.
Result<Convergence> converge(Scene& scene, const ConvergenceOptions& options, const ShareDone& progress = {});

}  // namespace cairn::rockfall
