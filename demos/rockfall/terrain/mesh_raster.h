// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "cairn/builder/triangle_mesh.h"
#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// The heights of a mesh (z up, open or closed) at points `cell` metres apart, from the lower corner of its box on:
/// where a vertical line meets several surfaces the topmost, where it meets none NaN. Exact but for rounding; what is
/// smaller than a cell is lost between the points. Fails for a cell that is not positive or gives too many points.
/// Cost: linear in triangles and the points below them.
Result<Raster> rasterOfMesh(const builder::TriangleMesh& mesh, double cell);

/// The same of a mesh file of any format the builder reads. Errors name the file.
Result<Raster> readMeshRaster(const std::filesystem::path& path, double cell);

}  // namespace cairn::rockfall
