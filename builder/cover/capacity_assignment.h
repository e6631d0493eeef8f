// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::builder {

/// Costs of giving items to bins, item by item.
struct CostTable {
  std::size_t bins = 0;
  std::vector<double> costs;  ///< of item i in bin k at i * bins + k

  std::size_t items() const { return bins == 0 ? 0 : costs.size() / bins; }
  double at(std::size_t item, std::size_t bin) const { return costs[item * bins + bin]; }
};

/// Gives every item to a bin, no bin more than `capacity`, so that the greatest cost is as small as can be (bottleneck
/// assignment: bisection over the costs, each answered by augmenting paths). Returns the bin by item. Deterministic.
/// Precondition: at least one bin, and items() <= bins * capacity.
std::vector<std::uint32_t> assignWithin(const CostTable& table, std::size_t capacity);

}  // namespace cairn::builder
