// SPDX-License-Identifier: GPL-3.0-or-later
#include "divide.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "cover/piece_costs.h"

namespace cairn::builder {

namespace {

struct Owner {
  std::size_t ball = 0;
  double cost = std::numeric_limits<double>::infinity();
  double biased = std::numeric_limits<double>::infinity();
};

/// Returns the cheapest ball, with bias, of those that hold a piece within `standOff`; the cheapest of all when none
/// does.
Owner ownerOf(std::span<const double> costs, std::span<const double> bias, double standOff) {
  Owner owner;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double cost = costs[i];
    const Owner candidate{i, cost, cost + bias[i]};
    const bool holds = cost <= standOff, held = owner.cost <= standOff;
    if (holds && held ? candidate.biased < owner.biased : cost < owner.cost) owner = candidate;
  }
  return owner;
}

/// Whether the owner has to grow as far for a corner of the piece alone, whatever takes the rest: no other ball holds
/// its farthest corner more cheaply. Then the rest costs nothing.
bool isNeededForACorner(PieceCosts& costs, const Piece& piece, const Ball& ball, double cost) {
  const auto& corners = piece.corners;
  const Vec3d farthest =
      *std::ranges::max_element(corners, {}, [&](const Vec3d& corner) { return lengthSq(corner - ball.center); });
  return *std::ranges::min_element(costs.of({{farthest, farthest, farthest}, piece.source})) >= cost;
}

}  // namespace

std::vector<Pieces> divide(Pieces pieces, std::span<const Ball> balls, std::span<const double> bias, double standOff,
                           double finest, Cutting cutting) {
  assert(!balls.empty() && bias.size() == balls.size() && finest > 0);
  PieceCosts costs(balls);
  std::vector<Pieces> parts(balls.size());
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const Owner owner = ownerOf(costs.of(piece), bias, standOff);
    if (owner.cost <= standOff || longestEdgeSq(piece) <= finest * finest ||
        (cutting == Cutting::whereItHelps && isNeededForACorner(costs, piece, balls[owner.ball], owner.cost))) {
      parts[owner.ball].push_back(piece);
    } else {
      const std::array<Piece, 2> halves = bisect(piece);
      pieces.push_back(halves[1]);
      pieces.push_back(halves[0]);
    }
  }
  return parts;
}

}  // namespace cairn::builder
