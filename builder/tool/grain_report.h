// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/core/mass_properties.h"
#include "tool/report.h"

namespace cairn::tool {

/// `volume`, `mass` at `density`, `center_of_mass`, `inertia` (full tensor about it, mesh axes, products as in
/// Ixy = -integral of x y) and its principal moments and axes, for reports. Mesh units.
Json massJson(const MassProperties& mass, double density);

}  // namespace cairn::tool
