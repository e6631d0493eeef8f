// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "rockfall/case/effect_options.h"

namespace cairn::rockfall {

/// Reads the effects in the order of the list. Effects of a place (water, forest_drag, trees, barrier) may occur
/// several times, the others once.
std::vector<EffectOptions> readEffects(const Value& value, const Materials& materials);

}  // namespace cairn::rockfall
