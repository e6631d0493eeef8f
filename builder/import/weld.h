// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/import.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// True when three corners span no area in double arithmetic.
bool isDegenerate(const std::array<Vec3d, 3>& corners);

/// Indexes a soup: one vertex per position, numbered by first use. Positions are compared exactly; zeros of either sign
/// are equal. Triangles without area are dropped. Vertices and triangles keep the file's order. O(n log n).
TriangleMesh weld(const TriangleSoup& soup, ImportCounts& counts);

}  // namespace cairn::builder
