// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Replaces the pieces of all regions, which were cut from triangles of another mesh with the same triangles, by those
/// that the same bisections cut from the triangles of `mesh`, whatever the lengths of their edges are there. A leaf's
/// pieces go on tiling what they tiled, so the cover of the tree carries over without a tolerance. Precondition: every
/// piece came out of a triangle of `from` by `bisect`, and the leaves together hold all of its surface. O(n log n) in
/// the pieces, parallel inside.
void cutAgain(RegionTree& tree, const TriangleMesh& from, const TriangleMesh& mesh);

}  // namespace cairn::builder
