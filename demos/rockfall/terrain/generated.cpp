// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/generated.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rockfall/terrain/raster.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {

namespace {

constexpr std::uint64_t kTerrainFamily = 0x67726F756E64;  // separate from the seeds of runs
constexpr double kBankWidth = 1;                          // metres over which a bank rises

// Rounds to float, so that a C library's last bit has no effect.
double slopeOf(double degrees) {
  return double(static_cast<float>(std::tan(degrees * std::numbers::pi / 180)));
}

// Returns the number of cells that cover a length. A length that is a whole number of cells up to rounding takes no
// additional cell.
double cellsOver(double length, double cell) {
  return std::max(std::ceil(length / cell - 1e-9), 1.0);
}

struct Layout {
  double cell;
  double firstX;     // of the points, metres
  double cells;      // along x
  double halfCells;  // along y, on each side of the middle
  double roughness;  // metres
  bool isMirrored;   // roughness included
};

Layout layoutOf(const GeneratedGrid& grid, double firstX, double length, double width) {
  return {grid.cellM,      firstX, cellsOver(length, grid.cellM), cellsOver(0.5 * width, grid.cellM),
          grid.roughnessM, false};
}

// Makes heights by `height(x, y)`, and adds roughness.
Result<bullet::TerrainGrid> makeGrid(const Layout& layout, std::uint64_t seed, const auto& height) {
  const auto columns = static_cast<std::uint64_t>(layout.cells) + 1,
             half = static_cast<std::uint64_t>(layout.halfCells);
  if (Status status = checkRasterSize(columns, 2 * half + 1); !status)
    return Error{"/terrain: a generated grid " + status.error().message + "; use a larger cell_m"};
  bullet::TerrainGrid grid;
  grid.columns = static_cast<std::uint32_t>(columns);
  grid.rows = static_cast<std::uint32_t>(2 * half + 1);
  grid.cell = layout.cell;
  grid.origin = {layout.firstX, -double(half) * layout.cell, 0};
  grid.heights.reserve(std::size_t(columns) * grid.rows);
  const std::uint64_t streams = mixBits(seed + kTerrainFamily);
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    const double y = (double(row) - double(half)) * layout.cell;
    const std::uint64_t noiseRow = layout.isMirrored && row < half ? 2 * half - row : row;
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      double z = height(layout.firstX + column * layout.cell, y);
      if (layout.roughness > 0)
        z += layout.roughness * scenes::Random(streams, noiseRow * columns + column).uniform(-1, 1);
      grid.heights.push_back(static_cast<float>(z));
    }
  }
  return grid;
}

double heightOf(const std::vector<MapPoint>& profile, double x) {
  std::size_t i = 1;
  while (i + 1 < profile.size() && profile[i][0] < x) ++i;
  const auto [x0, z0] = profile[i - 1];
  const auto [x1, z1] = profile[i];
  return z0 + std::clamp((x - x0) / (x1 - x0), 0.0, 1.0) * (z1 - z0);
}

}  // namespace

Result<bullet::TerrainGrid> generateTerrain(const PlaneTerrain& plane, std::uint64_t seed) {
  const double slope = slopeOf(plane.slopeDeg);
  return makeGrid(layoutOf(plane.grid, 0, plane.lengthM, plane.grid.widthM), seed,
                  [&](double x, double) { return (plane.lengthM - x) * slope; });
}

Result<bullet::TerrainGrid> generateTerrain(const SteppedSlopeTerrain& slope, std::uint64_t seed) {
  const double half = 0.5 * slope.grid.widthM, outside = slope.bankM > 0 ? kBankWidth + slope.grid.cellM : 0;
  const double first = slope.profileM.front()[0], last = slope.profileM.back()[0];
  return makeGrid(layoutOf(slope.grid, first, last - first, 2 * (half + outside)), seed, [&](double x, double y) {
    return heightOf(slope.profileM, x) + slope.bankM * std::clamp((std::abs(y) - half) / kBankWidth, 0.0, 1.0);
  });
}

Result<bullet::TerrainGrid> generateTerrain(const ChannelTerrain& channel, std::uint64_t seed) {
  const double slope = slopeOf(channel.slopeDeg), half = 0.5 * channel.grid.widthM;
  Layout layout = layoutOf(channel.grid, 0, channel.lengthM, channel.grid.widthM);
  layout.isMirrored = true;
  return makeGrid(layout, seed, [&](double x, double y) {
    return (channel.lengthM - x) * slope + channel.depthM * (y / half) * (y / half);
  });
}

Result<bullet::TerrainGrid> generateTerrain(const TalusConeTerrain& cone, std::uint64_t seed) {
  const double slope = slopeOf(cone.slopeDeg);
  Layout layout = layoutOf(cone.grid, 0, cone.grid.widthM, cone.grid.widthM);
  layout.firstX = -layout.halfCells * layout.cell;
  layout.cells = 2 * layout.halfCells;
  return makeGrid(layout, seed,
                  [&](double x, double y) { return std::max(0.0, cone.heightM - slope * std::sqrt(x * x + y * y)); });
}

}  // namespace cairn::rockfall
