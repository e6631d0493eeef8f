// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include "cairn/effects/effect_set.h"

namespace cairn::test {

/// The materials of the scenes with effects, and one that is nowhere in them.
inline constexpr effects::MaterialId kRock = 0, kSoil = 1, kIce = 2, kNowhere = 7;
inline constexpr btScalar kGravity = btScalar(9.81);

}  // namespace cairn::test
