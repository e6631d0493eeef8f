// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// Points farther than `error` from the solid, by proof (distance less its rounding bound), yet hardly farther, about
/// `spacing` apart all around it: a ball that protrudes by no more than `error` holds none of them. Mesh frame.
/// Preconditions: both > 0. Cost: some 10 distance queries a point. Parallel; the result does not depend on threads.
std::vector<Vec3d> outsidePoints(const SignedDistance& solid, double error, double spacing);

}  // namespace cairn::builder
