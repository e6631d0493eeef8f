// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>

namespace cairn::hard {

struct WorstPlaces {
  std::uint64_t places = 0;
  std::uint64_t lost = 0;  ///< at which a traversal, either way round, does not name all leaves that share a point
  double used = 0;         ///< of the overlap slack, by what moving the point's centre alone is off
};

/// Two trees of one point each, the same in the world, one a body's and both up to three compounds deep, where what
/// Bullet's floats and ours round by adds up to most: hill climbing from `starts` random places for each depth.
WorstPlaces climbToWorstPlaces(int starts, std::mt19937_64& engine);

}  // namespace cairn::hard
