// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/terrain/map_terrain.h"

namespace cairn::rockfall {

/// Raises the points of a terrain to the dams of its case, and adds a note on each. A crest is `heightM` above the
/// ground at the line's nearest point, as wide as given; its sides fall evenly until they meet the ground. Ends are
/// rounded. Each dam stands on those before it. Fails for a dam that raises no point, or less than half of its height:
/// points are as far apart as the terrain's cells. Call it once, in the map's coordinates, when maps are read.
Status raiseDams(Case& description, MapTerrain& terrain);

}  // namespace cairn::rockfall
