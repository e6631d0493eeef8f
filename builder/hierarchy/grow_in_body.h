// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "hierarchy/region_tree.h"

namespace cairn::builder {

/// Grows a tree of the solid it is given; an empty one when cancelled.
using Grow = std::function<RegionTree(const SignedDistance& solid)>;

/// What `grow` makes of the mesh as its own frame sees it (`bodyMesh`), brought back to the mesh: the same tree however
/// the mesh lies. The regions' pieces are cut from the mesh itself; balls and errors are those of the body's mesh,
/// moved, and so off by its rounding: measure them again. Empty when `grow` cancelled. Preconditions: those of
/// `BodyFrame` and, of what `grow` makes, `cutAgain`. Beside `grow` about one more signed distance.
RegionTree growInBody(const TriangleMesh& mesh, const Grow& grow);

}  // namespace cairn::builder
