// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/height_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr std::uint64_t kTerrainFamily = 0x67726F756E64;  // apart from the seeds of runs
constexpr double kMostPoints = 16e6;
constexpr double kBankWidth = 1;  // metres over which a bank rises

double tangent(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

/// A terrain before it is sampled: the part of the map it covers and its height there.
struct Surface {
  GeneratedGrid grid;
  MapPoint lower, upper;
  std::function<double(double x, double y)> height;
};

Surface surfaceOf(const PlaneTerrain& plane) {
  const double half = plane.grid.widthM / 2, slope = tangent(plane.slopeDeg), length = plane.lengthM;
  return {plane.grid, {0, -half}, {length, half}, [=](double x, double) { return (length - x) * slope; }};
}

Surface surfaceOf(const SteppedSlopeTerrain& steps) {
  const double half = steps.grid.widthM / 2, outside = steps.bankM > 0 ? kBankWidth + steps.grid.cellM : 0;
  const auto& profile = steps.profileM;
  return {steps.grid,
          {profile.front()[0], -half - outside},
          {profile.back()[0], half + outside},
          [=, bank = steps.bankM](double x, double y) {
            std::size_t i = 1;
            while (i + 1 < profile.size() && profile[i][0] < x) ++i;
            const auto [x0, z0] = profile[i - 1];
            const auto [x1, z1] = profile[i];
            const double t = std::clamp((x - x0) / (x1 - x0), 0.0, 1.0);
            return z0 + t * (z1 - z0) + bank * std::clamp((std::abs(y) - half) / kBankWidth, 0.0, 1.0);
          }};
}

Surface surfaceOf(const ChannelTerrain& channel) {
  const double half = channel.grid.widthM / 2, slope = tangent(channel.slopeDeg), length = channel.lengthM;
  return {channel.grid, {0, -half}, {length, half}, [=, depth = channel.depthM](double x, double y) {
            return (length - x) * slope + depth * (y / half) * (y / half);
          }};
}

Surface surfaceOf(const TalusConeTerrain& cone) {
  const double half = cone.grid.widthM / 2, slope = tangent(cone.slopeDeg), top = cone.heightM;
  return {cone.grid, {-half, -half}, {half, half}, [=](double x, double y) {
            return std::max(0.0, top - slope * std::sqrt(x * x + y * y));
          }};
}

Surface surfaceOf(const RasterTerrain&) {
  return {};
}
Surface surfaceOf(const MeshTerrain&) {
  return {};
}

}  // namespace

Result<HeightGrid> generateHeights(const TerrainSection& terrain, std::uint64_t seed) {
  const Surface surface = std::visit([](const auto& source) { return surfaceOf(source); }, terrain.source);
  HeightGrid grid;
  grid.origin = surface.lower;
  grid.cell = surface.grid.cellM;
  const double columns = std::ceil((surface.upper[0] - surface.lower[0]) / grid.cell - 1e-9) + 1;
  const double rows = std::ceil((surface.upper[1] - surface.lower[1]) / grid.cell - 1e-9) + 1;
  if (columns * rows > kMostPoints)
    return Error{
        fmt::format("/terrain: the grid would have {:.3g} million points, more than {:.0f} million: use a "
                    "larger cell_m",
                    columns * rows / 1e6, kMostPoints / 1e6)};
  grid.columns = static_cast<std::uint32_t>(columns);
  grid.rows = static_cast<std::uint32_t>(rows);
  scenes::Random random(mixBits(seed + kTerrainFamily));
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column)
      grid.heights.push_back(surface.height(grid.origin[0] + grid.cell * column, grid.origin[1] + grid.cell * row) +
                             surface.grid.roughnessM * random.uniform(-1, 1));
  return grid;
}

}  // namespace cairn::rockfall
