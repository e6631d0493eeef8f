// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {

namespace {

Error withoutGdal(const std::filesystem::path& path) {
  return Error{path.string() +
               ": this program was built without GDAL, which GeoTIFF and other rasters need: install libgdal-dev and "
               "build again, or use an ESRI ASCII grid (.asc)"};
}

}  // namespace

bool hasGdal() {
  return false;
}

Result<Raster> readByGdal(const std::filesystem::path& path) {
  return withoutGdal(path);
}

Status writeGeoTiff(const std::filesystem::path& path, const Raster& /*raster*/) {
  return withoutGdal(path);
}

}  // namespace cairn::rockfall
