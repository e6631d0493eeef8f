// SPDX-License-Identifier: GPL-3.0-or-later
#include "second_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "scenes/figures/quantiles.h"

namespace cairn::rockfall {

SecondTable::SecondTable(const bullet::StepBudget& budget) : budget_(budget.operations) {
  fmt::print(
      "        narrow phase, CPU ms  operations a step      of the   unresolved  certified   awake  fastest  lost\n");
  fmt::print("  time    median       max    median        max    budget        pairs      error   rocks      m/s\n");
}

void SecondTable::endSecond(std::uint32_t second, const scenes::World& world, std::uint32_t lost) {
  std::vector<double> times, operations;
  std::uint64_t pairs = 0, unresolved = 0;
  double error = 0;
  for (const scenes::StepRecord& step : steps_) {
    times.push_back(step.narrowPhaseCpuUs / 1000);
    operations.push_back(static_cast<double>(step.tree->operations));
    pairs += step.tree->pairs;
    unresolved += step.tree->unresolvedPairs;
    error = std::max(error, step.tree->worstErrorFraction);
  }
  steps_.clear();
  const scenes::Quantiles time = scenes::quantilesOf(times), work = scenes::quantilesOf(operations);
  std::string used = "no limit";
  if (budget_) used = *budget_ > 0 ? fmt::format("{:.0f} %", 100 * work.max / static_cast<double>(*budget_)) : "none";
  const std::size_t awake = world.bodies().size() - scenes::countAsleep(world.bodies());
  fmt::print("{:4d} s  {:8.3f}  {:8.3f}  {:8.0f}  {:9.0f}  {:>9}  {:8.2f} %  {:7.2f} %  {:6d}  {:7.2f}  {:4d}\n",
             second, time.median, time.max, work.median, work.max, used,
             pairs ? 100 * static_cast<double>(unresolved) / static_cast<double>(pairs) : 0.0, 100 * error, awake,
             scenes::fastestSpeed(world.bodies()), lost);
}

}  // namespace cairn::rockfall
