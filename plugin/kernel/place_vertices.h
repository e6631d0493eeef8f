// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/pose.h"
#include "cairn/core/surface_patches.h"

namespace cairn::bullet {

/// Transforms a patch's vertices into another frame, into three columns as long as the patch's own. Returns the box
/// around them. The same bits on every instruction set.
Box placeVertices(const SurfacePatch& patch, const Similarity& to, float* columns);

}  // namespace cairn::bullet
