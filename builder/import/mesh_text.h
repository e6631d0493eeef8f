// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Returns the polygons of an OBJ, OFF, PLY or text STL, by the extension of `path`. Coordinates are the doubles
/// nearest to the file's numbers. Nothing for other formats and for rare variants, which assimp reads: `4OFF`, `nOFF`
/// and binary STL.
///
/// Files for assimp are checked first, as far as these formats go. assimp accepts a bad number or a missing tail
/// without a message, or names no line. It waits forever for the rest of a truncated PLY and crashes on broken headers.
/// So assimp never reads a PLY.
///
/// OBJ: numbers are finite, faces have three or more existing vertices. OFF: as many lines as the header states and no
/// more, indices in range. STL: exactly as long as its count says, or statements in the order of the grammar up to the
/// last `endsolid`. PLY: all elements of the header are present, indices in range. Errors name the file and the line.
/// Linear.
Result<std::optional<PolygonSoup>> readMeshText(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace cairn::builder
