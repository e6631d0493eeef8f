// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/explain.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// What `explainEffects` asks of a scene, which must outlive the answer. Regions are looked at in a lattice of 256
/// points along each side of their box, and at their corners. Rocks that
/// find no free place begin higher: by as much as in run 0 and one rock more.
SceneBounds boundsOf(const Scene& scene);

}  // namespace cairn::rockfall
