// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "rockfall/simulation/scene_bounds.h"

namespace cairn::rockfall {

/// What `rockfall explain` prints, and its twin as JSON.
std::string explainText(const Scene& scene, const SceneBounds& bounds, const std::vector<EffectOutlook>& outlooks);
std::string explainJson(const Scene& scene, const SceneBounds& bounds, const std::vector<EffectOutlook>& outlooks);

}  // namespace cairn::rockfall
