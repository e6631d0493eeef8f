// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/gis/map_reader.h"

namespace cairn::rockfall {

/// Puts the zones of maps among those of the case, each where its list has it. See `readMaps`.
Status readZones(const MapReader& reader, Case& description);

}  // namespace cairn::rockfall
