// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/case.h"
#include "rockfall/terrain/map_terrain.h"

namespace cairn::rockfall {

/// Reads the maps that a case names and puts what they hold in their place: places of release, zones, collectors,
/// barriers and stems, in the terrain's coordinates, with a note on each. The case names no maps afterwards. A pure
/// function of the case and its files. Fails in one sentence with the path in the case: for a file that cannot be read,
/// another projection that cannot be brought into the terrain's, things of another kind than asked for, places of
/// release outside the terrain, maps of which nothing is over the terrain, and classes that the case does not list.
Status readMaps(Case& description, const MapTerrain& terrain);

}  // namespace cairn::rockfall
