// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/signed_distance.h"

namespace cairn::builder {

/// The thesis's measure of one sphere's error (7.1.1): the largest distance to the solid of points spread evenly over
/// the sphere, the 642 corners of an icosphere; 0 when all lie inside. A lower bound of the certified protrusion; no
/// point of the sphere is farther than 0.1 of its radius from a sample, which bounds how far below it can be.
double sampledProtrusion(const SignedDistance& solid, const Vec3d& center, double radius);

}  // namespace cairn::builder
