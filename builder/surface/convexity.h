// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// True when no vertex of a closed mesh lies more than `tolerance` (mesh unit) in front of any of its triangles'
/// planes. The mesh then equals its closing at any scale, to about the tolerance. Costs triangles times vertices when
/// the answer is true, far less when it is false. Meshes of more than 20,000 triangles count as concave without a test.
/// Closed sheets thinner than the tolerance count as convex, whatever their outline. The answer affects only the fit;
/// no certificate depends on it.
bool isConvex(const TriangleMesh& mesh, double tolerance);

}  // namespace cairn::builder
