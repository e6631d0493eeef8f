// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// The mesh as it would come back from its own file: coordinates rounded to float, vertices at equal positions made
/// one and numbered by first use, triangles that lost their area left out; `sha256` that of `plyBytes`. Not checked.
TriangleMesh settled(const TriangleMesh& mesh);

}  // namespace cairn::builder
