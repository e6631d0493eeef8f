// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "balls/depth_field.h"
#include "balls/piece.h"
#include "medial/hubbard_medial.h"

namespace cairn::builder {

/// A ball and the medial spheres that were merged into it, ascending. Its children are made from these spheres.
struct HubbardGroup {
  Ball ball;
  std::vector<std::uint32_t> members;
};

/// Hubbard's merging (thesis 4.3): neighbouring spheres merge into Ritter's ball around the forming points of both,
/// until `count` are left. The pair whose ball has the least error goes first. The error is the largest distance from a
/// forming point along its normal to the ball's surface (Eq. 4.1, 4.2). A sphere without neighbours gets those it
/// overlaps, or else all.
///
/// Preconditions: `members` are spheres of `medial`, ascending, not empty; `count` is at least 1. Cost: some 20 bounds
/// of an error for each member; few errors are computed in full. `keepGoing` is called now and then; once it returns
/// false, the result is empty.
std::vector<HubbardGroup> mergeHubbard(
    const HubbardMedial& medial, std::span<const std::uint32_t> members, std::size_t count, const DepthField& solid,
    const KeepGoing& keepGoing = [] { return true; });

/// Gives every piece to the group with the medial sphere nearest to its centroid, |p - c| - r, if that group's ball
/// holds the piece. Otherwise the ball would have to grow. Then the piece goes where the larger of two lengths is
/// least: the growth that the group's ball needs, and how much farther its nearest medial sphere is than the nearest of
/// all. On a tie the first group takes it. Part i of the result must lie in the ball of group i. Cost: a search of a
/// tree for each piece, and of all medial spheres for the few that make a ball grow; in parallel. Precondition:
/// `groups` is not empty.
std::vector<Pieces> divideByOwners(const HubbardMedial& medial, std::span<const HubbardGroup> groups,
                                   std::span<const Piece> pieces);

}  // namespace cairn::builder
