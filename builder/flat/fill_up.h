// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "flat/flat_problem.h"

namespace cairn::builder {

/// The set with balls added until there are `count`: small ones in the solid, near points of the surface far from all
/// centres. They stick out nowhere. A search ends with fewer balls only where more have nothing to lower. Depths of the
/// balls added are the solid's. Precondition: `balls` not empty.
SphereSet filledUp(SphereSet balls, std::size_t count, const PointSet& points, const SignedDistance& solid);

}  // namespace cairn::builder
