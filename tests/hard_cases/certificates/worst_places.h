// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace cairn::hard {

struct WorstPlaces {
  std::uint64_t places = 0;
  std::uint64_t lost = 0;  ///< at which a traversal, either way round, does not name all leaves that share a point
  /// Of the overlap slack, by what moving a ball's centre and leaving its radius is off: for bodies, for children of
  /// compounds, of compounds in compounds, and so on.
  std::vector<double> usedByDepth;
};

/// A tree of one point and one of one ball that has it on its sphere, up to four compounds deep, where what Bullet's
/// floats and ours round by adds up to most: for each depth `starts` times rotations that stretch most, found one by
/// one, then hill climbing of all there is by `steps` steps.
WorstPlaces climbToWorstPlaces(int starts, int steps, std::mt19937_64& engine);

}  // namespace cairn::hard
