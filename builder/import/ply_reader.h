// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// The polygons of a PLY file, faces or strips of triangles, in text or either binary form, coordinates as the doubles
/// nearest to what the file says. Fails when the header is broken, when there are no vertices with x, y and z or
/// nothing that lists their indices, when elements it promises are missing and when a face names too few vertices or
/// one that is not there; `file` is the file's name for the message. Linear.
Result<PolygonSoup> readPly(const std::string& file, std::string_view text);

}  // namespace cairn::builder
