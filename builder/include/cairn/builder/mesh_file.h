// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The mesh as the bytes of a binary PLY file, coordinates as floats. `importMesh` gives back exactly the meshes
/// `repair` and `wrap` return, whose coordinates are floats and whose vertices are numbered as an import numbers them;
/// a text format would go through the decimal arithmetic of whatever else reads it.
std::string plyBytes(const TriangleMesh& mesh);

}  // namespace cairn::builder
