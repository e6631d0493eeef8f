// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/ascii_grid.h"
#include "rockfall/terrain/geo_raster.h"

namespace cairn::rockfall {

Result<Raster> readRaster(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".asc" || extension == ".ASC" ? readAsciiGrid(path) : readByGdal(path);
}

}  // namespace cairn::rockfall
