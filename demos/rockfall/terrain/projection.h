// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/core/result.h"

namespace cairn::rockfall {

// Projections are texts: WKT, empty where it is not known which one.

/// Returns the projection of a name such as EPSG:2056. Fails, in what follows the name in an error, for one that is not
/// known, is in degrees or not in metres, and without GDAL.
Result<std::string> projectionNamed(const std::string& name);

/// Returns the projection of a .prj file's text. Without GDAL that text itself. Fails as above.
Result<std::string> projectionOfPrj(const std::string& text);

/// Returns the text of a .prj file, as ESRI's programs and GDAL read it.
std::string prjOf(const std::string& projection);

/// True if places have the same coordinates in both. Unknown ones differ from all.
bool isSameProjection(const std::string& a, const std::string& b);

/// Returns the shortest name there is for a reader: EPSG:2056, or its title.
std::string nameOfProjection(const std::string& projection);

}  // namespace cairn::rockfall
