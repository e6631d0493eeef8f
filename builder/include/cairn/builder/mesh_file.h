// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the mesh as the bytes of a binary PLY file with float coordinates. `importMesh` gives back exactly the
/// meshes of `repair` and `wrap`. Their coordinates are floats, and their vertices are numbered as an import numbers
/// them. A text format would depend on the decimal arithmetic of other readers. Linear.
///
///     writeFile("repaired.ply", plyBytes(repair(surface).value()));
std::string plyBytes(const TriangleMesh& mesh);

}  // namespace cairn::builder
