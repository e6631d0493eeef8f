// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "rockfall/case/scene_warnings.h"
#include "rockfall/simulation/scene_bounds.h"

namespace cairn::rockfall {

/// All that is to be said of a scene before it is run.
struct Explanation {
  SceneBounds bounds;
  std::vector<EffectOutlook> outlooks;
  std::vector<SceneWarning> warnings;
};
Explanation explain(const Scene& scene);

/// What `rockfall explain` prints, and its twin as JSON.
std::string explainText(const Scene& scene, const Explanation& explanation);
std::string explainJson(const Scene& scene, const Explanation& explanation);

}  // namespace cairn::rockfall
