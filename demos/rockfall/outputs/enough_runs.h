// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "rockfall/ensemble/run_range.h"
#include "rockfall/outputs/collector_statistics.h"
#include "rockfall/outputs/merged.h"

namespace cairn::rockfall {

/// One line that tells how many runs are missing beside those that there are, and which; nothing without any.
std::string missingText(const std::vector<RunRange>& missing, std::uint64_t runs);

/// Whether the runs are enough to tell a 95 % quantile.
struct QuantileCheck {
  std::string quantity, unit;  ///< "energy at road", "kJ"
  double quantile = 0;
  Interval bounds;
  std::uint64_t runs = 0;    ///< about so many would do; not more than there are: they are enough
  std::uint64_t values = 0;  ///< from which the quantile is
  std::uint64_t cutOff = 0;  ///< of these, such as may be too small

  /// So many values beyond the quantile would move it, and then no number of runs tells it.
  bool isCutOff() const { return areTooManyCutOff(cutOff, values); }
  bool isEnough(std::uint64_t had) const { return bounds.high && runs <= had && !isCutOff(); }
};

/// Run-outs of rocks that did not break.
struct Runouts {
  std::vector<double> metres;
  std::uint64_t cutOff = 0;  ///< of rocks without a whole way
  void add(const RockRecord& rock);
};

/// The run-out of rocks, and the energy of those at each collector that some reached.
std::vector<QuantileCheck> checkQuantiles(const Runouts& runouts, const std::vector<CollectorFigures>& collectors,
                                          std::uint64_t runs);

/// A line for each check.
std::string enoughText(const std::vector<QuantileCheck>& checks, std::uint64_t runs);

/// The same of the energy in each cell of the rasters.
struct CellsCheck {
  std::uint64_t cells = 0;   ///< that some rock reached
  std::uint64_t enough = 0;  ///< of them, those whose 95 % quantile the runs tell
  std::uint64_t runs = 0;    ///< about so many would do for nine cells in ten
};
CellsCheck checkCells(const MergedRuns& merged);

/// One line, or nothing without cells.
std::string enoughText(const CellsCheck& check);

}  // namespace cairn::rockfall
