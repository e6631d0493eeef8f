// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid_octants.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cairn::builder {

namespace {

/// Cubes are widened by this factor, far more than clipping rounds by, so that no point of the surface is lost between.
constexpr double kSlack = 1 + 1e-9;

/// True when the triangle meets the cube: what is left after clipping it at the six faces.
bool meets(const Cube& cube, const std::array<Vec3d, 3>& corners) {
  std::vector<Vec3d> polygon(corners.begin(), corners.end()), clipped;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto height = [&](const Vec3d& p) { return cube.halfEdge - side * (p[axis] - cube.center[axis]); };
      clipped.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = height(from), b = height(to);
        if (a >= 0) clipped.push_back(from);
        if ((a < 0) != (b < 0)) clipped.push_back(from + (to - from) * (a / (a - b)));
      }
      if (clipped.empty()) return false;
      polygon.swap(clipped);
    }
  return true;
}

bool fits(const Cube& cube, const Piece& piece) {
  return std::all_of(piece.corners.begin(), piece.corners.end(),
                     [&](const Vec3d& corner) { return distance(corner, cube.center) <= cube.circumradius(); });
}

/// The octants the piece meets; none for one that lies outside the cube, whose neighbours have it.
std::vector<unsigned> metBy(const Piece& piece, const std::array<Cube, 8>& octants) {
  std::vector<unsigned> met;
  for (unsigned i = 0; i < 8; ++i)
    if (meets({octants[i].center, octants[i].halfEdge * kSlack}, piece.corners)) met.push_back(i);
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
