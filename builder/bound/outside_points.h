// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cairn/builder/progress.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Returns points that are provably farther than `error` from the solid (distance less its rounding bound), but only
/// just. They lie about `spacing` apart all around it. A ball that protrudes by at most `error` holds none of them.
/// Mesh frame. Preconditions: both lengths > 0. Cost: about 10 distance queries for each point. Parallel; the result
/// does not depend on the number of threads. Once `keepGoing` returns false, it ends with those found so far.
std::vector<Vec3d> outsidePoints(
    const SignedDistance& solid, double error, double spacing, const KeepGoing& keepGoing = [] { return true; });

}  // namespace cairn::builder
