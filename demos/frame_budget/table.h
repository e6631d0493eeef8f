// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenes/figures/spread.h"
#include "scenes/world/run_cost.h"

namespace cairn::frame_budget {

/// A table on standard output: a title and one column a shape. Rows are printed as they are added.
class Table {
 public:
  explicit Table(std::vector<std::string> columns);

  /// `cell` is asked for each column in turn.
  void row(const std::string& title, const std::function<std::string(std::size_t column)>& cell) const;
  std::size_t columns() const { return columns_.size(); }
  const std::string& name(std::size_t column) const { return columns_[column]; }

 private:
  std::vector<std::string> columns_;
};

std::string milliseconds(double us);
/// Of a fraction, without the sign.
std::string percent(double fraction);
std::string meanAndMax(double mean, double max);
/// Mean, maximum and how many, or "none".
std::string spreadCell(const scenes::Spread& spread);
std::string medianAndMax(const scenes::Quantiles& quantiles);

/// The rows every scene has: times, work and size of the answer. One cost a column.
void printCost(const Table& table, std::span<const scenes::RunCost* const> costs);

}  // namespace cairn::frame_budget
