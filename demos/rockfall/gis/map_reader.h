// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>

#include "rockfall/case/case.h"
#include "rockfall/gis/map_layer.h"
#include "rockfall/terrain/map_terrain.h"
#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// The part of the map that a terrain covers, but for its holes.
struct MapBounds {
  MapPoint lower{}, upper{};

  bool contains(const MapPoint& point) const {
    return point[0] >= lower[0] && point[0] < upper[0] && point[1] >= lower[1] && point[1] < upper[1];
  }
  /// False only if no part of the feature is within.
  bool mayMeet(const MapFeature& feature) const;
};

enum class Shape : std::uint8_t { point, line, area };

/// Reads the maps of one case.
class MapReader {
 public:
  MapReader(const Case& description, const MapTerrain& terrain);

  const MapBounds& bounds() const { return bounds_; }
  /// Fails as `readMapLayer` does, for an empty layer, and for one that holds none or others than these shapes.
  Result<MapLayer> layer(const MapSource& source, std::initializer_list<Shape> shapes, const std::string& field) const;
  /// Fails as `readRaster` does, and for one in another projection than the terrain's, because cells cannot be moved.
  Result<Raster> raster(const MapSource& source) const;

  /// "places.gpkg: 12 features, 2 of them beyond the terrain, ...".
  MapNote note(const MapSource& source, const MapLayer& layer) const;
  MapNote note(const MapSource& source, const Raster& raster) const;
  /// A sentence with the path in the case and the file.
  static Error refused(const MapSource& source, const std::string& why);

 private:
  const Case& description_;
  const MapTerrain& terrain_;
  MapBounds bounds_;
};

/// How a class is written in a raster's cell: without a decimal point where there is nothing behind it.
std::string classOfCell(double value);

/// The meaning of a class, or the sentence that it has none. Nothing: the table says that there is nothing.
template <class Meaning>
Result<std::optional<Meaning>> meaningOf(const ClassTable<Meaning>& table, const std::string& name) {
  const auto found = table.classes.find(name);
  if (found != table.classes.end()) return found->second;
  return Error{"the class \"" + name + "\" has no meaning in the case: list it, with null if there is nothing there"};
}

}  // namespace cairn::rockfall
