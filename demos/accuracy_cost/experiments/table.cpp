// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/table.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

namespace cairn::accuracy_cost {
namespace {

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

}  // namespace

void Table::addRow(std::vector<std::string> row) {
  assert(row.size() == columns_.size());
  rows_.push_back(std::move(row));
}

std::size_t Table::indexOf(const std::string& column) const {
  const auto found = std::ranges::find(columns_, column);
  assert(found != columns_.end());
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& Table::text(std::size_t row, const std::string& column) const {
  return rows_[row][indexOf(column)];
}

double Table::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

std::vector<std::size_t> Table::select(const Where& where) const {
  std::vector<std::size_t> found;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (std::ranges::all_of(where, [&](const auto& w) { return text(row, w.first) == w.second; })) found.push_back(row);
  return found;
}

std::vector<double> Table::numbers(const std::string& column, const Where& where) const {
  std::vector<double> list;
  for (const std::size_t row : select(where))
    if (const double value = number(row, column); !std::isnan(value)) list.push_back(value);
  return list;
}

double Table::value(const std::string& column, const Where& where) const {
  const std::vector<double> list = numbers(column, where);
  return list.empty() ? std::numeric_limits<double>::quiet_NaN() : list.front();
}

std::vector<std::string> Table::texts(const std::string& column, const Where& where) const {
  std::vector<std::string> list;
  for (const std::size_t row : select(where))
    if (std::ranges::find(list, text(row, column)) == list.end()) list.push_back(text(row, column));
  return list;
}

std::string Table::csv() const {
  std::string text = fmt::format("{}\n", fmt::join(columns_, ","));
  for (const auto& row : rows_) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

Result<Table> Table::parse(const std::string& csv) {
  std::istringstream stream(csv);
  std::string line;
  if (!std::getline(stream, line) || line.empty()) return Error{"the table has no head"};
  Table table(cellsOf(line));
  while (std::getline(stream, line)) {
    std::vector<std::string> row = cellsOf(line);
    if (row.size() != table.columns_.size())
      return Error{fmt::format("row {} of the table has {} cells instead of {}", table.rows() + 1, row.size(),
                               table.columns_.size())};
    table.addRow(std::move(row));
  }
  return table;
}

}  // namespace cairn::accuracy_cost
