// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/map_source.h"

#include <array>
#include <filesystem>
#include <string_view>

namespace cairn::rockfall {

bool namesMap(Object& object) {
  const bool isVector = object.find("vector").has_value();
  return object.find("raster").has_value() || isVector;
}

MapSource readMapSource(Object& object) {
  MapSource source;
  source.path = object.path();
  const auto vector = object.find("vector"), raster = object.find("raster");
  if (vector && raster) object.refuse("only one of \"vector\" and \"raster\" may be given");
  source.isRaster = !vector;
  source.file = vector ? vector->text() : raster->text();
  if (!source.isRaster)
    if (const auto layer = object.find("layer")) source.layer = layer->text();
  return source;
}

PlacedLines readLines(Object& object) {
  PlacedLines placed;
  const auto line = object.find("line_m"), vector = object.find("vector");
  if (line.has_value() == vector.has_value())
    object.refuse("exactly one of \"line_m\" and \"vector\" must be given");
  else if (line)
    placed.lines = {readPolyline(*line)};
  else
    placed.map = readMapSource(object);
  return placed;
}

std::vector<std::string> filesBesideMap(const std::string& file) {
  static constexpr std::array<std::string_view, 5> kBeside{".shx", ".dbf", ".prj", ".cpg", ".tfw"};
  std::vector<std::string> files;
  for (const std::string_view extension : kBeside)
    files.push_back(std::filesystem::path(file).replace_extension(extension).string());
  files.push_back(file + ".aux.xml");
  return files;
}

}  // namespace cairn::rockfall
