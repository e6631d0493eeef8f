// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// A line on the map. Rocks that pass over or under it are counted and measured.
struct Collector {
  std::string name;
  std::array<MapPoint, 2> line{};
};

std::vector<Collector> readCollectors(const Value& value);

}  // namespace cairn::rockfall
