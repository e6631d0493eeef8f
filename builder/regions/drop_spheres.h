// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "regions/split_region.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Divides a region among as few balls as the balance of the settings allows (thesis 6.3, Alg. 11). `full` is its
/// division among all balls. With n of N children, the worst error is at most `allowedGrowth(N, n)` times that of
/// `full`; the result's `allowed` holds this limit. At least two children stay. Returns `full` itself when no child can
/// be dropped, or without a balance. Cost: `full.children.size()` optimisations for every child that is dropped or
/// tried. A pure function.
Split dropSpheres(const Split& full, const Region& region, const SignedDistance& solid, const SplitSettings& settings);

}  // namespace cairn::builder
