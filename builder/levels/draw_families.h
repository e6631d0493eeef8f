// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/two_levels.h"
#include "levels/upper_covers.h"

namespace cairn::builder {

/// Balls of a lower level below those of an upper one, before they are fitted to each other.
struct DrawnFamilies {
  CoverLevel upper;
  std::vector<ChildBall> children;
  double promise = 0;  ///< about the stand-off the lower level will need
};

/// Families for `problem`, drawn `draws` times: a cover of the whole surface by fewer balls than a full lower level,
/// from a random first ball, is grouped and shared (`groupParts`, `shareParts`) below parents. What a draw ends at is
/// decided by that cover, hardly by the walk of the parents, and differs by a tenth or two; so many rough covers, on
/// few points, find better pairs of levels than one good one. Draw k uses stream k of the seed.
///
/// `lower`: depths for the lower level. Deterministic, parallel over draws; a draw of 64 balls costs 0.2 s.
std::vector<DrawnFamilies> drawFamilies(const TwoLevelProblem& problem, const UpperCovers& uppers,
                                        const DepthField& lower, std::size_t draws);

}  // namespace cairn::builder
