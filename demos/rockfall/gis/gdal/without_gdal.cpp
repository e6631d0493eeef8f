// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/gis/geo_table.h"
#include "rockfall/gis/map_layer.h"

namespace cairn::rockfall {

Result<MapLayer> readMapLayer(const LayerRequest& request) {
  return Error{request.file.string() +
               ": this program was built without GDAL, which vector maps need: install libgdal-dev and build again, or "
               "give the coordinates in the case"};
}

namespace {

Error withoutGdal(const std::filesystem::path& path) {
  return Error{
      path.string() +
      ": this program was built without GDAL, which GeoPackage and GeoJSON need: install libgdal-dev and build "
      "again, or take the tables"};
}

}  // namespace

Status writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& /*tables*/,
                       const std::string& /*projection*/) {
  return withoutGdal(path);
}

Status writeGeoJson(const std::filesystem::path& path, const GeoTable& /*table*/, const std::string& /*projection*/) {
  return withoutGdal(path);
}

}  // namespace cairn::rockfall
