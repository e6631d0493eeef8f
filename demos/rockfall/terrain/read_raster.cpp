// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/core/atomic_file.h"
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"
#include "rockfall/terrain/projection.h"

namespace cairn::rockfall {
namespace {

/// An ESRI ASCII grid says where it is, and the .prj beside it in which projection.
Status addProjection(const std::filesystem::path& path, Raster& raster) {
  const std::filesystem::path beside = std::filesystem::path(path).replace_extension(".prj");
  if (!std::filesystem::exists(beside)) return {};
  const auto content = readFile(beside);
  if (!content) return content.error();
  auto projection = projectionOfPrj({reinterpret_cast<const char*>(content.value().data()), content.value().size()});
  if (!projection) return Error{beside.string() + " " + projection.error().message};
  raster.projection = std::move(projection).value();
  return {};
}

}  // namespace

Result<Raster> readRaster(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".asc" && extension != ".ASC") return readByGdal(path);
  auto raster = readAsciiGrid(path);
  if (!raster) return raster;
  if (const Status added = addProjection(path, raster.value()); !added) return added.error();
  return raster;
}

}  // namespace cairn::rockfall
