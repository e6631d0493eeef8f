// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Triangles of a file, each with its own three corners, in file order.
using TriangleSoup = std::vector<std::array<Vec3d, 3>>;

/// All triangles of all meshes of a file, placed by their nodes; a mirroring node turns its triangles around so that
/// they keep facing outward. The one place that calls assimp to read. Fails when assimp cannot read the file or finds
/// no triangles.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path);

/// The same of a text that is at hand and needs no other file; `path` gives the format and the name for errors.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path, std::span<const std::byte> text);

}  // namespace cairn::builder
