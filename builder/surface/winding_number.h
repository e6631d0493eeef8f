// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// How often a closed surface goes around a point: 1 inside a solid, 0 outside, within 1e-3 if the point is farther
/// from the surface than 1e-12 of its size; on the surface it means nothing. The sum of the triangles' solid angles
/// (Van Oosterom and Strackee 1983). Linear, some 50 ns a triangle.
double windingNumber(const TriangleMesh& mesh, const Vec3d& point);

}  // namespace cairn::builder
