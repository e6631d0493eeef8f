// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the parts of a mesh that are connected by edges, in the order of their first triangles. Shells that face
/// inward (cavities) stay with the part around them. Vertices are numbered by first use. Precondition: every edge has
/// two triangles.
std::vector<TriangleMesh> partsOf(const TriangleMesh& mesh);

}  // namespace cairn::builder
