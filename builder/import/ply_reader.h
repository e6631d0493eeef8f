// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Reads the polygons of a PLY file, faces or strips of triangles, in text or either binary form. Coordinates are the
/// doubles nearest to the file's numbers. `file` is the file's name for messages. Fails for a broken header, for a file
/// without x, y and z of vertices, and for one without lists of their indices. Fails too when elements are missing and
/// when a face has too few vertices or names a missing one. Linear.
Result<PolygonSoup> readPly(const std::string& file, std::string_view text);

}  // namespace cairn::builder
