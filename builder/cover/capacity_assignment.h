// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::builder {

/// Costs of the assignment of items to bins, item by item.
struct CostTable {
  std::size_t bins = 0;
  std::vector<double> costs;  ///< item i in bin k: at i * bins + k

  std::size_t items() const { return bins == 0 ? 0 : costs.size() / bins; }
  double at(std::size_t item, std::size_t bin) const { return costs[item * bins + bin]; }
};

/// Assigns every item to a bin, at most `capacity` to each, so that the greatest cost is minimal. This is bottleneck
/// assignment: bisection over the costs, with augmenting paths at each step. Returns the bin of each item.
/// Deterministic. Preconditions: at least one bin, and items() <= bins * capacity.
std::vector<std::uint32_t> assignWithin(const CostTable& table, std::size_t capacity);

}  // namespace cairn::builder
