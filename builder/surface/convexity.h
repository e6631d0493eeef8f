// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Whether no vertex of a closed mesh lies more than `tolerance` (mesh unit) in front of any of its triangles' planes:
/// then its closing at any scale is itself, to about that. Triangles times vertices where the answer is yes, far fewer
/// where it is no; meshes of more than 20,000 triangles are taken for concave unseen, closed sheets thinner than the
/// tolerance for convex, whatever their outline: a matter of fit, no certificate rests on it.
bool isConvex(const TriangleMesh& mesh, double tolerance);

}  // namespace cairn::builder
