// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/point_set.h"
#include "regions/region_normals.h"

namespace cairn::builder {

/// Up to `most` of the points that stand for all of them in contacts: the support function max p . d of the choice is
/// close to that of all points in the directions that matter, which are those the region faces.
///
/// Greedy: again and again the extreme point in the direction where the choice falls short most. First the directions
/// the region faces, then 98 evenly spread ones for what is left of `most`; ends early when nothing falls short by more
/// than `negligible`. Precondition: `points` not empty. O((|areas| capped at 64 + 98) * |points|).
std::vector<Vec3d> chooseSupportPoints(std::span<const Vec3d> points, std::span<const FacingArea> areas,
                                       std::size_t most, double negligible);

}  // namespace cairn::builder
