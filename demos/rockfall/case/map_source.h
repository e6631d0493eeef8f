// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rockfall/case/cursor.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// A file of a geographic information system that a case names. It is read when the scene is prepared, because its
/// places are brought into the terrain's coordinates.
struct MapSource {
  std::string path;  ///< of the object in the case that names it, for errors
  std::string file;
  bool isRaster = false;             ///< else a vector file: GeoJSON, GeoPackage, shapefile, FlatGeobuf
  std::optional<std::string> layer;  ///< of a vector file; its only one if not given
};

/// The meaning of the classes of a map: by the text of a field, or by the number in a raster's cells. Nothing: there is
/// nothing there.
template <class Meaning>
struct ClassTable {
  std::string field;  ///< of a vector file
  std::map<std::string, std::optional<Meaning>> classes;
};

/// True if the object has the key "vector" or "raster".
bool namesMap(Object& object);
/// Reads "vector", maybe with "layer", or "raster". Refuses both together. Precondition: `namesMap(object)`.
MapSource readMapSource(Object& object);

/// Reads "field", for vector files, and the table under `key`. `read` gives the meaning of a value that is not null.
template <class Meaning, class Read>
ClassTable<Meaning> readClasses(Object& object, const MapSource& source, std::string_view key, const Read& read) {
  ClassTable<Meaning> table;
  if (!source.isRaster) table.field = object.at("field").text();
  for (const auto& [name, value] : object.at(key).members())
    table.classes[name] = value.isNull() ? std::nullopt : std::optional<Meaning>(read(value));
  return table;
}

/// Lines that a case gives by their corners, or by a map.
struct PlacedLines {
  std::vector<Polyline> lines;
  std::optional<MapSource> map;
};
/// Reads exactly one of "line_m" and "vector".
PlacedLines readLines(Object& object);

/// The names that files belonging to a map have, where they are there: a shapefile's parts, a raster's .prj.
std::vector<std::string> filesBesideMap(const std::string& file);

}  // namespace cairn::rockfall
