// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// The polygons of a PLY file, in text or either binary form, coordinates as the doubles nearest to what the file says.
/// Nothing when it has no vertices with x, y and z or no faces with lists of their corners (but strips, say), which is
/// left to assimp. Fails when the header is broken, when elements it promises are missing and when a face names too few
/// vertices or one that is not there; `file` is the file's name for the message. Linear.
Result<std::optional<PolygonSoup>> readPly(const std::string& file, std::string_view text);

}  // namespace cairn::builder
