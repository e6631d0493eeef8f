// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial/hubbard_medial.h"
#include "spheres/depth_field.h"
#include "spheres/piece.h"

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
/// `members`: spheres of `medial`, ascending, not empty; `count` at least 1. Some 20 balls for each member.
std::vector<HubbardGroup> mergeHubbard(const HubbardMedial& medial, std::span<const std::uint32_t> members,
                                       std::size_t count, const DepthField& solid);

/// Gives every piece to the group with the medial sphere nearest to its centroid, |p - c| - r; part i of the result is
/// what group i has to hold. Linear in members times pieces. Precondition: `groups` not empty.
std::vector<Pieces> divideByOwners(const HubbardMedial& medial, std::span<const HubbardGroup> groups,
                                   std::span<const Piece> pieces);

/// The error of Eq. 4.1 and 4.2 for a point in the ball: how far the ball stands off along `normal` above `point`.
double normalStandOff(const Vec3d& center, double radius, const Vec3d& point, const Vec3d& normal);

}  // namespace cairn::builder
