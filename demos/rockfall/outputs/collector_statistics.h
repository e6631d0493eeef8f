// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rockfall/case/case.h"
#include "rockfall/outputs/sample.h"
#include "rockfall/simulation/run_result.h"

namespace cairn::rockfall {

/// The rocks that reached one collector: of each its greatest values there.
struct CollectorFigures {
  std::string name;
  std::uint64_t released = 0;  ///< rocks, in all runs; pieces of broken ones do not count
  std::uint64_t arrived = 0;   ///< of them, by themselves or by pieces
  Sample energyJ, speed, heightM;

  double probability() const { return released > 0 ? static_cast<double>(arrived) / static_cast<double>(released) : 0; }
};

/// Collects the crossings of all runs.
class CollectorStatistics {
 public:
  explicit CollectorStatistics(const Case& description);
  /// Adds a run.
  void add(const RunResult& result);
  /// The figures of every collector, in the case's order.
  std::vector<CollectorFigures> figures() const;

 private:
  struct Values {
    std::string name;
    std::uint64_t arrived = 0;
    std::vector<double> energyJ, speed, heightM;
  };
  std::uint64_t released_ = 0;
  std::vector<Values> collectors_;
};

/// collectors_summary.csv: a line for each collector.
std::string collectorsSummary(const std::vector<CollectorFigures>& figures);

}  // namespace cairn::rockfall
