// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "rockfall/outputs/log_histogram.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

/// What is known of rocks in cells and at distances. SI units.
enum class Quantity : std::uint8_t { energy, translation, rotation, speed, height };
inline constexpr std::size_t kQuantities = 5;

/// The rocks that passed through a cell of the map, or a distance from the release: one value for each rock and run.
struct CellSummary {
  std::array<LogHistogram, kQuantities> values;
  std::uint64_t stops = 0;
  std::uint64_t arrived = 0;  ///< released rocks that came here, by themselves or by pieces
  const LogHistogram& of(Quantity quantity) const { return values[static_cast<std::size_t>(quantity)]; }
  std::uint64_t passages() const { return of(Quantity::energy).count(); }
};

struct CollectorSummary {
  std::uint64_t crossings = 0;
  std::uint64_t rocks = 0;  ///< that crossed at least once
  LogHistogram energyJ, heightM, speed;
};

/// An ensemble in figures: integer counts, greatest values, histograms of fixed bins, and sums in the order of runs.
struct MergedRuns {
  using Cell = std::pair<std::int32_t, std::int32_t>;  ///< row, column

  std::uint64_t runs = 0, rocks = 0, impacts = 0;
  std::uint64_t released = 0;                      ///< rocks but for the pieces of broken ones
  std::array<std::uint64_t, kRockEnds> endings{};  ///< by `RockEnd`
  double runoutSumM = 0, releasedEnergyJ = 0;
  double energyRiseJ = 0;                  ///< the greatest of all runs
  std::uint64_t runoutsCutOff = 0;         ///< of rocks without a whole way
  LogHistogram runoutM, energyJ, heightM;  ///< run-outs of rocks that did not break
  std::map<Cell, CellSummary> cells;
  std::map<std::int32_t, CellSummary> distances;
  std::vector<CollectorSummary> collectors;
  std::vector<EffectRecord> effects;  ///< of all runs together, in the order of the case's list

  /// Adds a run. Call it in ascending order of runs. `cellM`: cell size of the rasters, if any.
  void add(const RunResult& result, std::optional<double> cellM);

 private:
  void addEffects(const std::vector<EffectRecord>& ofRun);
  void addCells(const RunResult& result);
};

}  // namespace cairn::rockfall
