// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {

namespace {

Error withoutGdal(const std::filesystem::path& path) {
  return Error{path.string() +
               ": this program was built without GDAL, which GeoTIFF and other rasters need: install libgdal-dev and "
               "build again, or use an ESRI ASCII grid (.asc)"};
}

}  // namespace

Result<std::string> projectionNamed(const std::string& /*name*/) {
  return Error{
      "cannot be looked up, because this program was built without GDAL: install libgdal-dev and build again, or leave "
      "it out"};
}

Result<std::string> projectionOfPrj(const std::string& text) {
  return text;
}

std::string prjOf(const std::string& projection) {
  return projection;
}

bool isSameProjection(const std::string& a, const std::string& b) {
  return !a.empty() && a == b;
}

std::string nameOfProjection(const std::string& projection) {
  return projection.empty() ? "a projection without a name" : projection.substr(0, projection.find(','));
}

bool hasGdal() {
  return false;
}

Result<Raster> readByGdal(const std::filesystem::path& path) {
  return withoutGdal(path);
}

Status writeGeoTiff(const std::filesystem::path& path, const Raster& /*raster*/, const BandText& /*text*/) {
  return withoutGdal(path);
}

}  // namespace cairn::rockfall
