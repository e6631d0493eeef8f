// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include "cairn/core/result.h"
#include "rockfall/gis/map_layer.h"

namespace cairn::rockfall {

/// Adds the parts of a geometry to a feature: curves as short lines, heights left out, brought into the coordinates of
/// `reprojection` unless it is null. Fails with what is wrong with the geometry.
Status addShapes(const OGRGeometry& geometry, OGRCoordinateTransformation* reprojection, MapFeature& feature);

}  // namespace cairn::rockfall
