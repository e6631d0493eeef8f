// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "rockfall/outputs/merged.h"
#include "rockfall/outputs/trajectories.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// A rock's last place, for the map.
struct StopPoint {
  MapPoint place{};
  RockEnd ending = RockEnd::resting;
};

/// Trajectories by speed over the shaded relief, where rocks ended, and the collectors; SVG. Of very many
/// trajectories and stops the first are drawn.
std::string mapFigure(const Case& description, const Ground& ground, const std::vector<Trajectory>& trajectories,
                      const std::vector<StopPoint>& stops);

/// Energy and height over the distance from the release: median, 95 %, greatest of the rocks that came so far, and how
/// many those are; SVG. Precondition: there are distances.
std::string profileFigure(const Case& description, const MergedRuns& merged, double cellM);

}  // namespace cairn::rockfall
