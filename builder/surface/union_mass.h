// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "cairn/builder/ball.h"
#include "surface/mass_properties.h"

namespace cairn::builder {

/// Moments of the union of balls about `reference`; see `massOf` in cairn/builder/grain.h.
Moments unionMoments(std::span<const Ball> balls, const Vec3d& reference);

}  // namespace cairn::builder
