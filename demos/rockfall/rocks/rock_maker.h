// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"
#include "rockfall/case/rocks_section.h"

namespace cairn::rockfall {

/// Makes a rock about 1 unit long. Angular rocks are hulls of random points on an ellipsoid, slabby rocks of points on
/// a flat one; rounded rocks are smooth ellipsoids. All are convex to the rounding of a double. Concave rocks also have
/// two to four dents and a rough surface. Their vertices move along rays from the centre, so they stay closed and free
/// of self-intersections. Equal arguments give equal bits.
builder::TriangleMesh makeRock(RockKind kind, bool concave, std::uint64_t seed);

}  // namespace cairn::rockfall
