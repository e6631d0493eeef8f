// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Makes one solid of the bodies of a mesh. Those that overlap or touch become one. Where bodies are within `tolerance`
/// of each other, the faces of the smaller one move into the larger one. Where solids touch along an edge only, a bead
/// of `tolerance` is laid around it. A mesh without any of these stays as it is. Vertices of the result are floats.
/// Places around which the surface winds backwards become solid. Fails, without the mesh's name, where floats are too
/// coarse.
///
/// Precondition: the mesh is settled and balanced, and its bodies face away from their solids.
Result<TriangleMesh> unite(const TriangleMesh& mesh, double tolerance, RepairCounts& counts);

}  // namespace cairn::builder
