// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Parents for the parts of a surface, each part below one and no parent above more than `branching`, as tight as a
/// search finds: a bottleneck assignment of the parts to parents and a fit of the parents to what they got, alternating
/// until nothing is gained, from many starts that displace the best parents so far. `start`: as many balls as there may
/// be parents, their centres where the search begins. Precondition: parts.size() <= start.size() * branching.
/// Deterministic.
SphereSet groupParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, std::size_t branching,
                     std::uint64_t seed);

}  // namespace cairn::builder
