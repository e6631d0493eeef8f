// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenes/figures/spread.h"
#include "scenes/world/run_cost.h"

namespace cairn::frame_budget {

/// A table on standard output with a title and one column for each shape. Rows are printed as they are added.
class Table {
 public:
  explicit Table(std::vector<std::string> columns);

  /// `cell` is called for each column in turn.
  void row(const std::string& title, const std::function<std::string(std::size_t column)>& cell) const;
  std::size_t columns() const { return columns_.size(); }
  const std::string& name(std::size_t column) const { return columns_[column]; }

 private:
  std::vector<std::string> columns_;
};

std::string milliseconds(double us);
/// Formats a fraction as a percentage, without the sign.
std::string percent(double fraction);
std::string meanAndMax(double mean, double max);
/// Formats mean, maximum and count, or "none".
std::string spreadCell(const scenes::Spread& spread);
std::string medianAndMax(const scenes::Quantiles& quantiles);

/// Prints the rows of every scene: times, work and number of contacts. Each column shows one cost.
void printCost(const Table& table, std::span<const scenes::RunCost* const> costs);

}  // namespace cairn::frame_budget
