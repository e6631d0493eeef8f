// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// The triangle nearest to a finite `query`, nearest child first, four boxes or triangles at a time with the fastest
/// instruction set present; the same bits on every one. On a tie one of them, always the same.
TriangleHierarchy::Place nearestTriangle(const TriangleHierarchy& hierarchy, const Vec3d& query);

}  // namespace cairn::builder
