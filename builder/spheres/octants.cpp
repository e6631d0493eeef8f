// SPDX-License-Identifier: GPL-3.0-or-later
#include "octants.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace cairn::builder {

Vec3d cornerOf(const Cube& cube, unsigned which) {
  const double half = cube.halfEdge;
  return cube.center +
         Vec3d((which & 1U) != 0 ? half : -half, (which & 2U) != 0 ? half : -half, (which & 4U) != 0 ? half : -half);
}

Cube octantOf(const Cube& cube, unsigned which) {
  const Cube middle{cube.center, cube.halfEdge * 0.5};
  return {cornerOf(middle, which), middle.halfEdge};
}

namespace {

unsigned octantAt(const Cube& cube, const Vec3d& point) {
  return (point.x >= cube.center.x ? 1U : 0U) | (point.y >= cube.center.y ? 2U : 0U) |
         (point.z >= cube.center.z ? 4U : 0U);
}

bool holds(const Cube& octant, const Piece& piece) {
  const double radiusSq = 3 * octant.halfEdge * octant.halfEdge;
  return std::all_of(piece.corners.begin(), piece.corners.end(),
                     [&](const Vec3d& corner) { return lengthSq(corner - octant.center) <= radiusSq; });
}

std::vector<Octant> octantsOf(Pieces pieces, const Cube& cube, double finest) {
  std::array<Pieces, 8> parts;
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const unsigned home = octantAt(cube, centroidOf(piece));
    if (holds(octantOf(cube, home), piece) || longestEdgeSq(piece) <= finest * finest) {
      parts[home].push_back(piece);
    } else {
      const std::array<Piece, 2> halves = bisect(piece);
      pieces.push_back(halves[1]);
      pieces.push_back(halves[0]);
    }
  }
  std::vector<Octant> octants;
  for (unsigned i = 0; i < 8; ++i)
    if (!parts[i].empty()) octants.push_back({octantOf(cube, i), std::move(parts[i])});
  return octants;
}

}  // namespace

Cube cubeAround(const Bounds& bounds) {
  const Vec3d extent = bounds.upper - bounds.lower;
  return {bounds.center(), 0.5 * std::max({extent.x, extent.y, extent.z})};
}

std::vector<Octant> divideByOctants(const Pieces& pieces, Cube cube, double finest) {
  assert(finest > 0);
  std::vector<Octant> octants = octantsOf(pieces, cube, finest);
  // Once the ball around a cube is smaller than the finest piece, octants cannot separate the surface further.
  while (octants.size() == 1 && cube.circumradius() > finest) {
    cube = octants.front().cube;
    octants = octantsOf(std::move(octants.front().pieces), cube, finest);
  }
  return octants;
}

}  // namespace cairn::builder
