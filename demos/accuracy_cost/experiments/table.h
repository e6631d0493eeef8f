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

/// Columns and what rows are to have in them.
using Where = std::vector<std::pair<std::string, std::string>>;

/// A cell's text: of a number that does not exist, none. A name stays what it is, whatever it is.
template <class T>
std::string cellOf(const T& value) {
  if constexpr (std::is_floating_point_v<T>)
    if (std::isnan(value)) return {};
  return fmt::format("{}", value);
}

/// What an experiment measured: the CSV file, in memory. Units are part of the columns' names. Cells are text without
/// commas, quotes or line breaks; numbers are written with the digits to give back the same doubles; an empty cell is a
/// number that does not exist.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// One row. Precondition: a cell for each column.
  template <class... Cells>
  void add(const Cells&... cells) {
    addRow({cellOf(cells)...});
  }
  void addRow(std::vector<std::string> row);

  std::size_t rows() const { return rows_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  /// Precondition: there is such a column.
  const std::string& text(std::size_t row, const std::string& column) const;
  /// NaN for an empty cell. Precondition: likewise.
  double number(std::size_t row, const std::string& column) const;

  /// Rows that have all this.
  std::vector<std::size_t> select(const Where& where) const;
  /// Numbers of a column in these rows, in order, without those that do not exist.
  std::vector<double> numbers(const std::string& column, const Where& where) const;
  /// The first of them, NaN without any.
  double value(const std::string& column, const Where& where) const;
  /// The different texts of a column, in the order they appear.
  std::vector<std::string> texts(const std::string& column, const Where& where = {}) const;

  /// A head, then a line for each row.
  std::string csv() const;
  /// Fails for text that is no such table.
  static Result<Table> parse(const std::string& csv);

 private:
  std::size_t indexOf(const std::string& column) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace cairn::accuracy_cost
