// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The parts of a mesh whose triangles hang together by edges, in the order of their first triangles, except that
/// shells facing inwards (cavities) stay with the part around them. Vertices are numbered by first use. Precondition:
/// every edge has two triangles.
std::vector<TriangleMesh> partsOf(const TriangleMesh& mesh);

}  // namespace cairn::builder
