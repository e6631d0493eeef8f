// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rockfall/case/map_source.h"
#include "rockfall/case/materials.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// The common options of generated terrains: z up, downhill along +x, the middle at y = 0.
struct GeneratedGrid {
  double widthM = 0;      ///< across, in y
  double cellM = 1;       ///< between grid points
  double roughnessM = 0;  ///< greatest displacement of a grid point, up or down; by the case's seed
};

/// An even slope that begins at x = 0 and ends at height 0.
struct PlaneTerrain {
  GeneratedGrid grid;
  double lengthM = 0;   ///< in x
  double slopeDeg = 0;  ///< below the horizontal
};

/// Risers and benches between banks: straight between the corners of a profile, the same over the whole width.
struct SteppedSlopeTerrain {
  GeneratedGrid grid;
  std::vector<MapPoint> profileM;  ///< x and z, x rising
  double bankM = 0;                ///< how far the ground rises over one metre beyond each edge
};

/// An even slope with a parabolic cross-section.
struct ChannelTerrain {
  GeneratedGrid grid;
  double lengthM = 0;
  double slopeDeg = 0;
  double depthM = 0;  ///< of the middle below the edges
};

/// A cone about the origin on level ground.
struct TalusConeTerrain {
  GeneratedGrid grid;  ///< square: the width is the length too
  double heightM = 0;
  double slopeDeg = 0;
};

/// An elevation raster of any format GDAL reads.
struct RasterTerrain {
  std::string file;
};

/// A surface mesh, sampled from above.
struct MeshTerrain {
  std::string file;
  double cellM = 1;
};

using TerrainSource =
    std::variant<PlaneTerrain, SteppedSlopeTerrain, ChannelTerrain, TalusConeTerrain, RasterTerrain, MeshTerrain>;

/// A material for each square cell of a grid.
struct MaterialGrid {
  /// Of cells that have none.
  static constexpr MaterialId kNone = std::numeric_limits<MaterialId>::max();

  std::uint32_t columns = 0, rows = 0;
  double cellM = 1;
  MapPoint cornerM{};                 ///< of the first cell, where x and y are least
  std::vector<MaterialId> materials;  ///< row by row from the south, each along x

  /// Nothing outside the grid, and in cells without a material.
  std::optional<MaterialId> at(const MapPoint& point) const;
};

/// A part of the ground with its own material. Where zones overlap, the last one counts.
struct Zone {
  MaterialId material = 0;
  Area area;
  MapPoint lower{}, upper{};         ///< bounding box of the area; it quickly excludes most points
  std::size_t item = 0;              ///< its place in the case's list
  std::optional<MaterialGrid> grid;  ///< in place of material and area

  /// Nothing where the zone is not.
  std::optional<MaterialId> at(const MapPoint& point) const;
};
Zone makeZone(MaterialId material, Area area);

/// Zones of a map by their classes.
struct MappedZones {
  MapSource map;
  std::size_t item = 0;  ///< its place in the case's list
  ClassTable<MaterialId> materials;
  std::optional<MaterialId> only;  ///< in place of the table: all that the map holds is of this material
};

/// A dam, or a wall with steep sides: an embankment along lines whose crest is so high above the ground below it.
struct Dam {
  std::vector<Polyline> lines;
  std::optional<MapSource> map;  ///< of the lines; they are there once it is read
  double heightM = 0, crestM = 0;
  std::array<double, 2> slopeDeg{};  ///< of its left and right side, seen along the line
};

struct TerrainSection {
  TerrainSource source;
  MaterialId material = 0;
  MaterialGrid grid;                ///< before `material`; empty: there is none
  std::vector<Zone> zones;          ///< before `grid`, the last first
  std::vector<MappedZones> mapped;  ///< more zones, not read yet
  std::vector<Dam> dams;            ///< on the source, one after the other
  std::optional<std::string> crs;   ///< of the coordinates, where the terrain's file does not say it: EPSG:2056

  MaterialId materialAt(const MapPoint& point) const;
};

TerrainSection readTerrain(const Value& value, const Materials& materials);

}  // namespace cairn::rockfall
