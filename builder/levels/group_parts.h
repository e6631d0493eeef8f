// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "balls/sphere_set.h"

namespace cairn::builder {

/// Finds parents for the parts of a surface, as tight as a search finds them. Each part has one parent, and no parent
/// has more than `branching` parts. A bottleneck assignment of parts to parents alternates with a fit of the parents to
/// their parts, until nothing improves. Many starts displace the best parents so far.
///
/// `start`: as many balls as there may be parents; the search begins at their centres. Precondition: parts.size() <=
/// start.size() * branching. Deterministic.
SphereSet groupParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, std::size_t branching,
                     std::uint64_t seed);

}  // namespace cairn::builder
