// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "cairn/core/result.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// What becomes of the up direction that a Collada file names.
enum class UpDirection : std::uint8_t {
  turned,   ///< it is turned to y, as assimp does by itself
  ignored,  ///< coordinates stay those of the file
};

/// Reads all triangles of all meshes of a file, placed by their nodes. A node that mirrors reverses its triangles, so
/// that they still face outward. Only this file reads with assimp, which stores coordinates in single precision. Fails
/// when assimp cannot read the file or finds no triangles.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path, UpDirection up);

/// Reads the triangles of a text in memory that needs no other file. `path` gives the format, and the name for errors.
Result<TriangleSoup> readTriangles(const std::filesystem::path& path, std::span<const std::byte> text, UpDirection up);

}  // namespace cairn::builder
