// SPDX-License-Identifier: GPL-3.0-or-later
#include "capacity_assignment.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>

namespace cairn::builder {

namespace {

/// Bipartite matching with room for several items in a bin, by augmenting paths.
class Matching {
 public:
  Matching(const CostTable& table, double limit, std::size_t capacity)
      : table_(table), limit_(limit), capacity_(capacity), members_(table.bins), binOf_(table.items(), 0) {}

  /// Returns the bin of each item; nothing when some item cannot be placed at the limit.
  std::optional<std::vector<std::uint32_t>> run() {
    for (std::size_t item = 0; item < table_.items(); ++item) {
      seen_.assign(table_.bins, false);
      if (!place(item)) return std::nullopt;
    }
    return binOf_;
  }

 private:
  bool place(std::size_t item) {
    for (const std::size_t bin : cheapestFirst(item)) {
      if (table_.at(item, bin) > limit_) return false;
      if (seen_[bin]) continue;
      seen_[bin] = true;
      if (members_[bin].size() < capacity_) {
        members_[bin].push_back(item);
        binOf_[item] = static_cast<std::uint32_t>(bin);
        return true;
      }
      for (std::size_t m = 0; m < members_[bin].size(); ++m) {
        if (!place(members_[bin][m])) continue;
        members_[bin][m] = item;
        binOf_[item] = static_cast<std::uint32_t>(bin);
        return true;
      }
    }
    return false;
  }

  std::vector<std::size_t> cheapestFirst(std::size_t item) const {
    std::vector<std::size_t> order(table_.bins);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return table_.at(item, a) < table_.at(item, b); });
    return order;
  }

  const CostTable& table_;
  double limit_;
  std::size_t capacity_;
  std::vector<std::vector<std::size_t>> members_;
  std::vector<std::uint32_t> binOf_;
  std::vector<bool> seen_;
};

}  // namespace

std::vector<std::uint32_t> assignWithin(const CostTable& table, std::size_t capacity) {
  assert(table.bins > 0 && table.items() <= table.bins * capacity);
  std::vector<double> limits = table.costs;
  std::sort(limits.begin(), limits.end());
  std::size_t low = 0, high = limits.empty() ? 0 : limits.size() - 1;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (Matching(table, limits[middle], capacity).run())
      high = middle;
    else
      low = middle + 1;
  }
  if (limits.empty()) return {};
  return *Matching(table, limits[low], capacity).run();
}

}  // namespace cairn::builder
