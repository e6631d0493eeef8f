// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "rockfall/simulation/release.h"
#include "rockfall/simulation/run_result.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

struct FinishedRun {
  RunResult result;
  RunCost cost;
};

/// Simulates one run to its end: the case's duration, or until all rocks have been released and sleep or are gone. Asks
/// `keepGoing` every hundred steps and fails with `builder::kCancelled` if it says no; fails as the world and
/// the shapes do.
Result<FinishedRun> simulate(const Scene& scene, std::uint64_t run, const std::function<bool()>& keepGoing = {});

/// The same of rocks that begin as `releases` say, in the world's coordinates, in place of those that the case draws.
Result<FinishedRun> simulate(const Scene& scene, std::uint64_t run, std::vector<ReleasedRock> releases,
                             const std::function<bool()>& keepGoing = {});

}  // namespace cairn::rockfall
