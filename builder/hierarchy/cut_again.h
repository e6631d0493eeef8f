// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Transfers the pieces of all regions to another mesh with the same triangles. The same bisections, applied to the
/// triangles of `mesh`, give the new pieces, whatever the lengths of the edges are there. The pieces of a leaf tile the
/// same part of the surface as before. So the tree's cover carries over without a tolerance.
///
/// Precondition: `bisect` made every piece from a triangle of `from`, and the leaves together hold its whole surface.
/// O(n log n) in the pieces, parallel.
void cutAgain(RegionTree& tree, const TriangleMesh& from, const TriangleMesh& mesh);

}  // namespace cairn::builder
