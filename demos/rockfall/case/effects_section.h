// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "rockfall/case/effect_options.h"

namespace cairn::rockfall {

/// Effects in the order they are listed. Those of a place (water, forest_drag, trees) may come several times, the
/// others once.
std::vector<EffectOptions> readEffects(const Value& value, const Materials& materials);

}  // namespace cairn::rockfall
