// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// Columns, and the texts that rows must have in them.
using Where = std::vector<std::pair<std::string, std::string>>;

/// Returns a cell's text; empty for NaN. A text stays unchanged.
template <class T>
std::string cellOf(const T& value) {
  if constexpr (std::is_floating_point_v<T>)
    if (std::isnan(value)) return {};
  return fmt::format("{}", value);
}

/// The measurements of an experiment: the CSV file, in memory. Units are part of the columns' names. Cells are texts
/// without commas, quotes or line breaks. Numbers have enough digits to give back the same doubles. An empty cell is a
/// number that does not exist.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Adds one row. Precondition: there is one cell for each column.
  template <class... Cells>
  void add(const Cells&... cells) {
    addRow({cellOf(cells)...});
  }
  void addRow(std::vector<std::string> row);

  std::size_t rows() const { return rows_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  /// Precondition: the column exists.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// NaN for an empty cell. Precondition: the column exists.
  double number(std::size_t row, const std::string& column) const;

  /// Returns the rows that satisfy all conditions.
  std::vector<std::size_t> select(const Where& where) const;
  /// Returns the numbers of a column in these rows, in order, without empty cells.
  std::vector<double> numbers(const std::string& column, const Where& where) const;
  /// Returns the first of these numbers; NaN without any.
  double value(const std::string& column, const Where& where) const;
  /// Returns the different texts of a column, in the order in which they appear.
  std::vector<std::string> texts(const std::string& column, const Where& where = {}) const;

  /// Returns a header line, then one line for each row.
  std::string csv() const;
  /// Fails for a text that is no such table.
  static Result<Table> parse(const std::string& csv);

 private:
  std::size_t indexOf(const std::string& column) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace cairn::accuracy_cost
