// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/block_runs.h"

#include "rockfall/simulation/run.h"

namespace cairn::rockfall {
namespace {

// Apart for every block, whichever are run: effects may draw numbers.
std::uint64_t numberOf(const BlockRun& run) {
  constexpr std::uint64_t kMaxBlocks = 100000, kMaxDrops = 1000, kMaxOrientations = 100000;
  return ((run.profile * kMaxBlocks + run.block) * kMaxDrops + run.drop) * kMaxOrientations + run.orientation;
}

}  // namespace

Result<std::vector<BlockEnd>> simulateBlocks(const QuarryScene& quarry, std::span<const BlockRun> runs,
                                             std::uint32_t jobs, const ShareDone& progress) {
  const auto compute = [&](std::size_t item, std::span<BlockEnd> ends,
                           const std::function<bool()>& keepGoing) -> Status {
    const BlockRun& run = runs[item];
    const auto finished = simulate(quarry.scene, numberOf(run), {releaseOf(quarry, run)}, keepGoing);
    if (!finished) return finished.error();
    const RockRecord& rock = finished.value().result.rocks.front();
    ends.front() = {rock.end, rock.ending, rock.maxSpeed, rock.maxEnergyJ, rock.endS};
    return {};
  };
  return computeEach<BlockEnd>(runs.size(), 1, jobs, compute, progress);
}

}  // namespace cairn::rockfall
