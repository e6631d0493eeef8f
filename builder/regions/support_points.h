// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/point_set.h"
#include "regions/region_normals.h"

namespace cairn::builder {

/// Chooses up to `most` points that represent all of them in contacts. The support function max p . d of the choice is
/// close to that of all points in the directions that the region faces.
///
/// The choice is greedy: it takes the extreme point in the direction with the largest deficit, again and again. It
/// first uses the directions that the region faces, then 98 evenly spread ones for the rest of `most`. It ends early
/// when no deficit exceeds `negligible`. Precondition: `points` is not empty. O((|areas| capped at 64 + 98) *
/// |points|).
std::vector<Vec3d> chooseSupportPoints(std::span<const Vec3d> points, std::span<const FacingArea> areas,
                                       std::size_t most, double negligible);

}  // namespace cairn::builder
