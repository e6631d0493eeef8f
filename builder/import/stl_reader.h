// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Reads the facets of a text STL: statements in the order of the grammar, letters of either case, any number of
/// solids. Nothing for a binary file, which is exactly as long as its count of triangles says. A file of that length is
/// binary, whatever its header begins with. Errors name the file and the line. Linear.
Result<std::optional<PolygonSoup>> readStl(const std::string& file, std::string_view text);

}  // namespace cairn::builder
