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

}  // namespace

std::vector<Pieces> divide(Pieces pieces, std::span<const Ball> balls, std::span<const double> bias, double standOff,
                           double finest) {
  assert(!balls.empty() && bias.size() == balls.size() && finest > 0);
  PieceCosts costs(balls);
  std::vector<Pieces> parts(balls.size());
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const Owner owner = ownerOf(costs.of(piece), bias, standOff);
    if (owner.cost <= standOff || longestEdgeSq(piece) <= finest * finest) {
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
