// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "cairn/core/result.h"

namespace cairn::builder {

/// Checks what a mesh file says before assimp sees it, by the extension of `path`: assimp passes over a bad number or a
/// missing tail in silence, stops with a message that names no line, or (PLY) waits forever for the rest. OBJ: numbers
/// finite, faces of three or more existing vertices. OFF: as many lines as the header promises, indices in range. STL:
/// as long as its count says, or ended by `endsolid`. PLY: all the elements the header promises. Other formats pass.
/// Errors name the file and the line. Linear.
Status checkMeshText(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace cairn::builder
