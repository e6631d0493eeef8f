// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Reads a mesh as `importSurface` does, but ignores the up direction that a Collada file names: the frame of a URDF's
/// mesh is that of the file's coordinates. RViz and MoveIt (geometric_shapes) take it so too.
Result<TriangleMesh> importRobotSurface(const std::filesystem::path& path);

}  // namespace cairn::builder
