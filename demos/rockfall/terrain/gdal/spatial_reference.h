// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_spatialref.h>

#include <string>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Fails for one in degrees or in another unit than metres; nothing is said of null.
Status checkUnits(const OGRSpatialReference* reference);

/// The reference of a WKT, with x before y. Precondition: GDAL made the text, or it is empty.
OGRSpatialReference referenceOf(const std::string& projection);

/// The WKT of a reference; empty for null.
std::string projectionOf(const OGRSpatialReference* reference);

/// See `isSameProjection`.
bool isSame(const OGRSpatialReference& a, const OGRSpatialReference& b);

/// See `nameOfProjection`.
std::string nameOf(const OGRSpatialReference& reference);

}  // namespace cairn::rockfall
