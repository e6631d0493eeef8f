// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/explain.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// Returns the bounds for `explainEffects`; the scene must outlive them. Regions are sampled at 256 points along each
/// side of their box, and at their corners; places of release from maps at as many drawn points. Rocks without a free
/// place start higher. The bound adds the greatest such height of run 0 and one rock more.
SceneBounds boundsOf(const Scene& scene);

}  // namespace cairn::rockfall
