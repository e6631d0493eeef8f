// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "balls/depth_field.h"
#include "balls/piece.h"
#include "medial/hubbard_medial.h"

namespace cairn::builder {

/// A ball and the medial spheres that were merged into it, ascending: its children are made from these.
struct HubbardGroup {
  Ball ball;
  std::vector<std::uint32_t> members;
};

/// Hubbard's merging (thesis 4.3): neighbouring spheres merge into Ritter's ball around the forming points of both
/// until `count` are left. The pair goes first whose ball has the least error, the largest distance from a forming
/// point along its normal to the ball's surface (Eq. 4.1, 4.2). A sphere without neighbours gets those it overlaps, or
/// else all.
///
/// `members`: spheres of `medial`, ascending, not empty; `count` at least 1. Some 20 bounds of an error for each
/// member, few of which are worked out. `keepGoing` is asked now and then; once it says no, the result is empty.
std::vector<HubbardGroup> mergeHubbard(
    const HubbardMedial& medial, std::span<const std::uint32_t> members, std::size_t count, const DepthField& solid,
    const KeepGoing& keepGoing = [] { return true; });

/// Gives every piece to the group with the medial sphere nearest to its centroid, |p - c| - r; part i of the result is
/// what group i has to hold. On a tie the first group. A search of a tree for each piece, in parallel. Precondition:
/// `groups` not empty.
std::vector<Pieces> divideByOwners(const HubbardMedial& medial, std::span<const HubbardGroup> groups,
                                   std::span<const Piece> pieces);

}  // namespace cairn::builder
