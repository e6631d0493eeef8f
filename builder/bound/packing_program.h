// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cairn::builder {

/// The linear program "as much weight as possible on `columns` points, at most 1 on each point and in each row's set".
/// Rows are added as they are found; each solution starts from the last. The answers are those of a solver in floating
/// point and prove nothing by themselves. Deterministic.
class PackingProgram {
 public:
  explicit PackingProgram(std::size_t columns);
  ~PackingProgram();
  PackingProgram(const PackingProgram&) = delete;
  PackingProgram& operator=(const PackingProgram&) = delete;

  /// `points` are column numbers, each once.
  void addRow(std::span<const std::uint32_t> points);

  /// The weights of an optimum, none negative; empty when the solver gave up.
  std::vector<double> solve();

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace cairn::builder
