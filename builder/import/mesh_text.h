// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// The polygons of an OBJ, OFF, PLY or text STL, coordinates as the doubles nearest to what the file says; the
/// extension of `path` tells the format. Nothing for other formats and for the rarer forms of these, which are left to
/// assimp: `4OFF` and `nOFF`, binary STL.
///
/// Whatever is left to assimp has been checked as far as these formats go, because assimp passes over a bad number or a
/// missing tail in silence, or stops with a message that names no line; a PLY it waits forever for the rest of, and
/// broken headers crash it, so that it never sees one. OBJ: numbers finite, faces of three or more existing vertices.
/// OFF: as many lines as the header promises and no more, indices in range. STL: exactly as long as its count says, or
/// statements in the order of the grammar up to the last `endsolid`. PLY: all the elements the header promises, indices
/// in range. Errors name the file and the line. Linear.
Result<std::optional<PolygonSoup>> readMeshText(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace cairn::builder
