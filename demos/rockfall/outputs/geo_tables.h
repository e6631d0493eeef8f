// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "rockfall/gis/geo_table.h"
#include "rockfall/outputs/collector_statistics.h"
#include "rockfall/outputs/trajectories.h"

namespace cairn::rockfall {

/// The tables of an ensemble with places on the map. They grow run by run in memory.
class GeoTables {
 public:
  GeoTables();
  /// Adds a run. Call it in ascending order of runs.
  void add(const RunResult& result);

  /// "trajectories", of runs that recorded them, and "stops", where rocks ended.
  const GeoTable& trajectories() const { return trajectories_; }
  const GeoTable& stops() const { return stops_; }

 private:
  GeoTable trajectories_, stops_;
};

/// "collectors", with their figures. Both lists are in the case's order.
GeoTable collectorsTable(const Case& description, const std::vector<CollectorFigures>& figures);

}  // namespace cairn::rockfall
