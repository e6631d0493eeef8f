// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/world_origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

constexpr double kFar = 1e4;            // metres from the map's origin
constexpr double kFarthest = 16384;     // metres: below, a float is rounded by 2^-11 m at most
constexpr double kWholeNumbers = 1000;  // metres: of them the world's origin is made

double farthest(double from, double to) {
  return std::max(std::abs(from), std::abs(to));
}

double middle(double from, double to) {
  return std::round((from + to) / 2 / kWholeNumbers) * kWholeNumbers;
}

double highest(const bullet::TerrainGrid& grid) {
  double most = 0;
  for (const float height : grid.heights) most = std::max(most, std::abs(grid.origin.z + double(height)));
  return most;  // NaN stays out: it is not greater
}

/// Moves everything in a case that has a place on the map.
struct Mover {
  MapPoint origin;

  void move(MapPoint& point) const { point = {point[0] - origin[0], point[1] - origin[1]}; }
  void move(Polygon& polygon) const {
    for (MapPoint& corner : polygon) move(corner);
  }
  void move(Zone& zone) const {
    move(zone.area.outline);
    for (Polygon& hole : zone.area.holes) move(hole);
    move(zone.lower);
    move(zone.upper);
    if (zone.grid) move(zone.grid->cornerM);
  }
  void operator()(TreesOptions& trees) const {
    if (auto* stand = std::get_if<StandOfTrees>(&trees.stems)) return move(stand->polygon);
    if (auto* stems = std::get_if<std::vector<Stem>>(&trees.stems))
      for (Stem& stem : *stems) move(stem.placeM);
  }
  void operator()(BarrierOptions& barrier) const {
    for (Polyline& line : barrier.lines) move(line);
  }
  void operator()(auto& effect) const {
    if constexpr (requires { effect.polygon; }) move(effect.polygon);
  }
};

}  // namespace

Result<MapPoint> worldOriginOf(const bullet::TerrainGrid& grid) {
  const double x0 = grid.origin.x, x1 = x0 + grid.cell * (grid.columns - 1);
  const double y0 = grid.origin.y, y1 = y0 + grid.cell * (grid.rows - 1);
  MapPoint origin{};
  if (std::max(farthest(x0, x1), farthest(y0, y1)) >= kFar) origin = {middle(x0, x1), middle(y0, y1)};
  const double reach = std::max(farthest(x0 - origin[0], x1 - origin[0]), farthest(y0 - origin[1], y1 - origin[1]));
  const double height = highest(grid);
  if (std::max(reach, height) <= kFarthest) return origin;
  return Error{
      fmt::format("/terrain: the ground reaches {:.1f} km from its middle, its heights {:.1f} km, and single "
                  "precision tells half a millimetre up to {:.1f} km: cut out a smaller part of the map",
                  reach / 1000, height / 1000, kFarthest / 1000)};
}

void moveToWorld(Case& description, const MapPoint& origin) {
  const Mover mover{origin};
  for (Zone& zone : description.terrain.zones) mover.move(zone);
  mover.move(description.terrain.grid.cornerM);
  for (RockGroup& group : description.rocks) {
    for (MapPoint& corner : group.release.boxM) mover.move(corner);
    group.release.places.moveBy({-origin[0], -origin[1]});
  }
  for (Collector& collector : description.collectors)
    for (Polyline& line : collector.lines) mover.move(line);
  for (EffectOptions& effect : description.effects) std::visit(mover, effect);
}

void moveToMap(RunResult& result, const MapPoint& origin) {
  const Vec3d by(origin[0], origin[1], 0);
  for (RockRecord& rock : result.rocks) {
    rock.start = rock.start + by;
    rock.end = rock.end + by;
  }
  for (ImpactRecord& impact : result.impacts) impact.place = impact.place + by;
  for (auto& trajectory : result.trajectories)
    for (TrajectorySample& sample : trajectory) sample.place = sample.place + by;
}

}  // namespace cairn::rockfall
