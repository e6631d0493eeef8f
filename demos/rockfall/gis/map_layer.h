// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

/// One object of a vector map: all its parts, in the terrain's coordinates. Heights in the file are left out, because
/// the terrain has them.
struct MapFeature {
  std::int64_t id = 0;  ///< in its file
  std::vector<MapPoint> points;
  std::vector<Polyline> lines;
  std::vector<Area> areas;
  std::optional<std::string> text;  ///< of the field that was asked for; nothing where the file has nothing
};

/// A layer of a vector map.
struct MapLayer {
  std::vector<MapFeature> features;
  std::uint64_t withoutPlace = 0;  ///< features that were left out, because they have no geometry
  std::string reprojectedFrom;     ///< name of the file's projection; empty: it is the terrain's, or not said
};

/// A layer to read.
struct LayerRequest {
  std::filesystem::path file;
  std::optional<std::string> layer;  ///< the file's only one if not given
  std::string field;                 ///< whose text is asked for; empty: none
  std::string projection;            ///< of the terrain, as WKT; empty: not known
};

/// Reads a layer of a GeoJSON file, a GeoPackage, a shapefile or a FlatGeobuf file. Coordinates of another projection
/// are brought into the terrain's and rounded to a tenth of a millimetre. A file that does not say its projection is
/// taken to be in the terrain's. Fails, in one sentence that names the file, for all else that cannot be right: several
/// layers and no name, no such layer or field, polygons that cross themselves, coordinates that are no numbers or far
/// from any map, projections between which no transformation is known; and without GDAL.
Result<MapLayer> readMapLayer(const LayerRequest& request);

}  // namespace cairn::rockfall
