// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/world/world.h"

namespace cairn::rockfall {

/// The table on standard output: one line for each simulated second, from the steps it is told.
class SecondTable {
 public:
  explicit SecondTable(const bullet::StepBudget& budget);
  void add(const scenes::StepRecord& step) { steps_.push_back(step); }
  /// Prints what was added since the last call.
  void endSecond(std::uint32_t second, const scenes::World& world, std::uint32_t lost);

 private:
  std::optional<std::int64_t> budget_;
  std::vector<scenes::StepRecord> steps_;
};

}  // namespace cairn::rockfall
