// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_octants.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "surface/triangle_in_cube.h"

namespace cairn::builder {

namespace {

/// Cubes are widened by this factor, far more than the rounding of clipping, so that no point of the surface is lost
/// between them.
constexpr double kOctantSlack = 1 + 1e-9;

bool fits(const Cube& cube, const Piece& piece) {
  return std::all_of(piece.corners.begin(), piece.corners.end(),
                     [&](const Vec3d& corner) { return distance(corner, cube.center) <= cube.circumradius(); });
}

/// The octants that the piece meets; none for a piece outside the cube, which belongs to the cube's neighbours.
std::vector<unsigned> metBy(const Piece& piece, const std::array<Cube, 8>& octants) {
  std::vector<unsigned> met;
  for (unsigned i = 0; i < 8; ++i)
    if (triangleMeetsCube(piece.corners, octants[i].center, octants[i].halfEdge * kOctantSlack)) met.push_back(i);
  return met;
}

SolidOctants solidOctantsOf(Pieces pieces, const Cube& cube, double finest, const SignedDistance& solid) {
  std::array<Cube, 8> octants;
  for (unsigned i = 0; i < 8; ++i) octants[i] = octantOf(cube, i);
  std::array<Pieces, 8> held;
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const std::vector<unsigned> met = metBy(piece, octants);
    if (longestEdgeSq(piece) > finest * finest &&
        std::any_of(met.begin(), met.end(), [&](unsigned i) { return !fits(octants[i], piece); })) {
      const std::array<Piece, 2> halves = bisect(piece);
      pieces.push_back(halves[1]);
      pieces.push_back(halves[0]);
      continue;
    }
    for (const unsigned i : met) held[i].push_back(piece);
  }
  SolidOctants parts;
  for (unsigned i = 0; i < 8; ++i) {
    if (!held[i].empty()) {
      parts.surface.push_back({octants[i], std::move(held[i])});
    } else if (solid.depth(octants[i].center) > 0) {
      parts.inside.push_back(octants[i]);
    }
  }
  return parts;
}

}  // namespace

SolidOctants divideSolid(const Pieces& pieces, Cube cube, double finest, const SignedDistance& solid) {
  SolidOctants parts = solidOctantsOf(pieces, cube, finest, solid);
  while (parts.surface.size() == 1 && parts.inside.empty() && cube.circumradius() > finest) {
    cube = parts.surface.front().cube;
    parts = solidOctantsOf(std::move(parts.surface.front().pieces), cube, finest, solid);
  }
  return parts;
}

}  // namespace cairn::builder
