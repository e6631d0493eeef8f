// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "rockfall/case/case.h"

namespace cairn::rockfall {

/// Heights over a square lattice, row by row along x; between four points two triangles share the diagonal along +x +y.
struct HeightGrid {
  MapPoint origin{};
  double cell = 1;
  std::uint32_t columns = 0, rows = 0;
  std::vector<double> heights;

  double at(std::uint32_t column, std::uint32_t row) const { return heights[std::size_t{row} * columns + column]; }
};

/// The grid of generated terrain, a pure function of section and seed. Fails above 16 million points. Precondition: the
/// source is a generated one.
Result<HeightGrid> generateHeights(const TerrainSection& terrain, std::uint64_t seed);

}  // namespace cairn::rockfall
