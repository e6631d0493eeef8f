// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/dams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace cairn::rockfall {
namespace {

using bullet::TerrainGrid;

/// The point of a dam's lines that is nearest to another.
struct Nearest {
  double distanceM = std::numeric_limits<double>::infinity();
  MapPoint point{};
  bool isLeft = true;  ///< of the line, seen along it
};

Nearest nearestOf(const std::vector<Polyline>& lines, const MapPoint& to) {
  Nearest nearest;
  for (const Polyline& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) {
      const MapPoint &from = line[i - 1], &end = line[i];
      const double x = end[0] - from[0], y = end[1] - from[1], dx = to[0] - from[0], dy = to[1] - from[1];
      const double along = std::clamp((dx * x + dy * y) / (x * x + y * y), 0.0, 1.0);
      const MapPoint point{from[0] + along * x, from[1] + along * y};
      const double distance = std::hypot(to[0] - point[0], to[1] - point[1]);
      if (distance < nearest.distanceM) nearest = {distance, point, x * dy - y * dx >= 0};
    }
  return nearest;
}

/// The height between the four points around a place; nothing beside the grid and at holes.
std::optional<double> heightAt(const TerrainGrid& grid, const MapPoint& place) {
  const double x = (place[0] - grid.origin.x) / grid.cell, y = (place[1] - grid.origin.y) / grid.cell;
  if (!(x >= 0 && y >= 0 && x <= grid.columns - 1 && y <= grid.rows - 1)) return {};
  const auto column = std::min(static_cast<std::size_t>(x), std::size_t(grid.columns) - 2);
  const auto row = std::min(static_cast<std::size_t>(y), std::size_t(grid.rows) - 2);
  const double u = x - static_cast<double>(column), v = y - static_cast<double>(row);
  const auto at = [&](std::size_t i, std::size_t j) {
    return static_cast<double>(grid.heights[(row + j) * grid.columns + column + i]);
  };
  const double height = (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
  return std::isnan(height) ? std::nullopt : std::optional(height);
}

/// The height of a dam's surface over a place.
std::optional<double> surfaceOf(const Dam& dam, const TerrainGrid& ground, const MapPoint& place) {
  const Nearest nearest = nearestOf(dam.lines, place);
  const auto foot = heightAt(ground, nearest.point);
  if (!foot) return {};
  const double slope = std::tan(dam.slopeDeg[nearest.isLeft ? 0 : 1] * std::numbers::pi / 180);
  return *foot + dam.heightM - slope * std::max(0.0, nearest.distanceM - dam.crestM / 2);
}

struct Raised {
  std::size_t points = 0;
  double mostM = 0;
};

Raised raise(const Dam& dam, TerrainGrid& grid) {
  const TerrainGrid ground = grid;
  Raised raised;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      float& height = grid.heights[std::size_t(row) * grid.columns + column];
      if (std::isnan(height)) continue;
      const auto surface =
          surfaceOf(dam, ground, {grid.origin.x + column * grid.cell, grid.origin.y + row * grid.cell});
      if (!surface || *surface <= double(height)) continue;
      ++raised.points;
      raised.mostM = std::max(raised.mostM, *surface - double(height));
      height = static_cast<float>(*surface);
    }
  return raised;
}

}  // namespace

Status raiseDams(Case& description, MapTerrain& terrain) {
  constexpr double kMinShare = 0.5;
  for (std::size_t i = 0; i < description.terrain.dams.size(); ++i) {
    const Dam& dam = description.terrain.dams[i];
    const Raised raised = raise(dam, terrain.grid);
    const std::string path = fmt::format("/terrain/dams/{}", i);
    if (raised.mostM < kMinShare * dam.heightM)
      return Error{
          fmt::format("{}: it raises {} points of the ground, by {:.2g} m at most: points are {:g} m apart, so "
                      "give the dam a wider crest, or take a finer terrain, and place the dam on it",
                      path, raised.points, raised.mostM, terrain.grid.cell)};
    description.notes.push_back(
        {path, fmt::format("a dam of {:g} m raises {} points of the ground, by {:.3g} m at most", dam.heightM,
                           raised.points, raised.mostM)});
  }
  return {};
}

}  // namespace cairn::rockfall
