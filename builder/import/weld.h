// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/import.h"
#include "import/polygon_soup.h"

namespace cairn::builder {

/// Whether three corners span no area, as far as double arithmetic can tell.
bool isDegenerate(const std::array<Vec3d, 3>& corners);

/// Indexes a soup: one vertex per position (exact, zero of either sign alike), numbered by first use; triangles without
/// area left out. Vertices and triangles keep the order of the file. O(n log n).
TriangleMesh weld(const TriangleSoup& soup, ImportCounts& counts);

}  // namespace cairn::builder
