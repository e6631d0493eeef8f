// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Grows a tree of the given solid; returns an empty tree when cancelled.
using Grow = std::function<RegionTree(const SignedDistance& solid)>;

/// Calls `grow` in the mesh's own frame (`bodyMesh`) and moves the tree back to the mesh. The tree is therefore the
/// same in every pose of the mesh. The regions' pieces are cut from the mesh itself. Balls and errors are those of the
/// body's mesh, moved, and differ by its rounding: measure them again.
///
/// Empty when `grow` was cancelled. Preconditions: those of `BodyFrame`; the tree of `grow` satisfies those of
/// `cutAgain`. Cost beside `grow`: about one more signed distance.
RegionTree growInBody(const TriangleMesh& mesh, const Grow& grow);

}  // namespace cairn::builder
