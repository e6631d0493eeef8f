// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "levels/two_levels.h"
#include "levels/upper_covers.h"

namespace cairn::builder {

/// Balls of a lower level below those of an upper one, before the two are fitted to each other.
struct DrawnFamilies {
  CoverLevel upper;
  std::vector<ChildBall> children;
  double promise = 0;  ///< estimate of the stand-off that the lower level will need
};

/// Draws families for `problem`, `draws` times. A draw covers the whole surface by fewer balls than a full lower level,
/// from a random first ball. It then groups and shares them below parents (`groupParts`, `shareParts`). That cover
/// decides the result of a draw; the walk of the parents hardly matters. Results differ by a tenth or two. So many
/// approximate covers, on few points, find better pairs of levels than one good cover. Draw k uses stream k of the
/// seed.
///
/// `lower`: depths for the lower level. Deterministic, parallel over draws. A draw of 64 balls costs 0.2 s.
std::vector<DrawnFamilies> drawFamilies(const TwoLevelProblem& problem, const UpperCovers& uppers,
                                        const DepthField& lower, std::size_t draws);

}  // namespace cairn::builder
