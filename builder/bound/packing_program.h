// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/builder/progress.h"

namespace cairn::builder {

/// A linear program: maximise the total weight of `columns` points, with at most 1 on each point and in each row's set.
/// Rows can be added later; each solution starts from the last one. The solver works in floating point, so its answers
/// prove nothing by themselves. Deterministic.
///
///     PackingProgram program(points.size());
///     program.addRow(pointsOfOneBall);
///     const std::vector<double> weights = program.solve(keepGoing);
class PackingProgram {
 public:
  explicit PackingProgram(std::size_t columns);
  ~PackingProgram();
  PackingProgram(const PackingProgram&) = delete;
  PackingProgram& operator=(const PackingProgram&) = delete;

  /// `points` are column numbers without repetition.
  void addRow(std::span<const std::uint32_t> points);

  /// Returns the weights of an optimum, none negative; empty when the solver failed or was told to stop.
  std::vector<double> solve(const KeepGoing& keepGoing);

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace cairn::builder
