// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"
#include "rockfall/case/rocks_section.h"

namespace cairn::rockfall {

/// A rock about 1 unit long. Angular ones are the hull of points strewn over an ellipsoid, slabby ones of a flat
/// ellipsoid, rounded ones smooth ellipsoids: convex to the rounding of a double. Concave ones keep that look but have
/// two to four dents and a rough surface, moved along rays from the centre, so that they stay closed and free of
/// self-intersections. Equal arguments give equal bits.
builder::TriangleMesh makeRock(RockKind kind, bool concave, std::uint64_t seed);

}  // namespace cairn::rockfall
