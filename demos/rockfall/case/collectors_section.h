// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rockfall/case/map_source.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// A line on the map, maybe in several parts. Rocks that pass over or under it are counted and measured.
struct Collector {
  std::string name;
  std::vector<Polyline> lines;
  std::optional<MapSource> map;  ///< of the lines; they are there once it is read
};

std::vector<Collector> readCollectors(const Value& value);

}  // namespace cairn::rockfall
