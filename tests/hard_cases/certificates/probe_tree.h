// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "oracle/chain_of_balls.h"

namespace cairn::hard {

/// How many points a probe tree holds.
inline constexpr std::uint32_t kProbes = 512;

/// A tree whose leaf number i is the least ball a tree can keep around the point i: its centre is the point rounded to
/// float, its radius the rounding. Three levels of eight over each other, errors 0. `nodeOf(tree, i)` names the leaf.
/// Precondition: `kProbes` points; neighbours in the list should be near each other.
SphereTree probeTree(std::span<const Wide> points);

/// A tree whose leaves all are this ball.
SphereTree probeTree(const Sphere& ball);

NodeId nodeOfProbe(const SphereTree& tree, std::uint32_t index);

}  // namespace cairn::hard
