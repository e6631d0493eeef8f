// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/signed_distance.h"

namespace cairn::builder {

/// Returns the thesis's measure of one sphere's error (7.1.1). It is the largest distance to the solid from the 642
/// corners of an icosphere on the sphere; 0 when all lie inside. It is a lower bound of the certified protrusion. No
/// point of the sphere is farther than 0.1 of its radius from a sample, which limits the difference.
double sampledProtrusion(const SignedDistance& solid, const Vec3d& center, double radius);

}  // namespace cairn::builder
