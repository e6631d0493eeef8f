// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "cairn/builder/triangle_mesh.h"
#include "rockfall/terrain/raster.h"

namespace cairn::rockfall {

/// Samples the heights of a mesh (z up, open or closed) at points `cell` metres apart, from the lower corner of its box
/// on. A point takes the topmost surface on its vertical line, NaN without any. Exact up to rounding; details smaller
/// than a cell are lost between the points. Fails for a cell that is not positive or gives too many points. Cost:
/// linear in the triangles and the points below them.
Result<Raster> rasterOfMesh(const builder::TriangleMesh& mesh, double cell);

/// Samples a mesh file of any format that the builder reads. Errors name the file.
Result<Raster> readMeshRaster(const std::filesystem::path& path, double cell);

/// Lifts the raster's values to the mesh where it is higher, or where there is none yet.
void drape(const builder::TriangleMesh& mesh, Raster& raster);

}  // namespace cairn::rockfall
