// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "balls/sphere_set.h"
#include "regions/region.h"
#include "regions/split_region.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Fits balls to a region by the settings' method: at most `problem.count`, optimised as the settings say. For
/// `swapRounds` see `optimiseBySwaps`. `problem.points` are the corners of the region's pieces, or a spread choice of
/// them; neighbours are at most `spacing` apart. For methods with `fitsRegions`. A pure function.
SphereSet reduce(const CoverProblem& problem, const Region& region, double spacing, const SignedDistance& solid,
                 const SplitSettings& settings, int swapRounds);

}  // namespace cairn::builder
