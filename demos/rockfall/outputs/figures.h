// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "rockfall/outputs/merged.h"
#include "rockfall/outputs/trajectories.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// The end point of a rock, for the map.
struct StopPoint {
  MapPoint place{};
  RockEnd ending = RockEnd::resting;
};

/// Draws the trajectories, coloured by speed, over the shaded relief, with the rocks' end points and the collectors, as
/// SVG. With very many trajectories and stops, only the first are drawn.
std::string mapFigure(const Case& description, const Ground& ground, const std::vector<Trajectory>& trajectories,
                      const std::vector<StopPoint>& stops);

/// Draws energy and height over the distance from the release as SVG: median, 95 % and greatest value of the rocks that
/// came so far, and their number. Precondition: there are distances.
std::string profileFigure(const Case& description, const MergedRuns& merged, double cellM);

}  // namespace cairn::rockfall
