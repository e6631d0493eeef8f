// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the mesh as an import of its own file would: coordinates are rounded to float and vertices at equal
/// positions joined. Vertices are numbered by first use; triangles that lost their area are dropped. `sha256` is that
/// of `plyBytes`. The result is not checked.
TriangleMesh settled(const TriangleMesh& mesh);

}  // namespace cairn::builder
