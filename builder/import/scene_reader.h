// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// All triangles of all meshes of a file, placed by their nodes; a mirroring node turns its triangles around so that
/// they keep facing outward. The one place that calls assimp to read, which keeps coordinates in single precision.
/// Fails when assimp cannot read the file or finds no triangles.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path);

/// The same of a text that is at hand and needs no other file; `path` gives the format and the name for errors.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path, std::span<const std::byte> text);

}  // namespace cairn::builder
