// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rockfall/case/effect_options.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {

/// A stem of the stand, at a place that was drawn before. Heights take a number of the stream only where they spread.
inline Stem drawStem(const StandOfTrees& stand, const MapPoint& place, scenes::Random& random) {
  const double diameter = random.uniform(stand.diameterM[0], stand.diameterM[1]);
  const auto& [low, high] = stand.heightM;
  return {place, diameter, low < high ? random.uniform(low, high) : low};
}

}  // namespace cairn::rockfall
