// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Returns the number of times a closed surface winds around a point: 1 inside a solid, 0 outside. The error is below
/// 1e-3 if the point is farther from the surface than 1e-12 of its size; on the surface the value is arbitrary. It is
/// the sum of the triangles' solid angles (Van Oosterom and Strackee 1983). Linear, about 50 ns for each triangle.
double windingNumber(const TriangleMesh& mesh, const Vec3d& point);

}  // namespace cairn::builder
