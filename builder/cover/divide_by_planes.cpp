// SPDX-License-Identifier: GPL-3.0-or-later
#include "divide_by_planes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cairn::builder {

namespace {

/// Margin for rounding: a ball fitted to points holds them.
constexpr double kSlack = 1 + 1e-12;

/// The distance from the centre to the farthest corner.
double reachOf(const Ball& ball, const Piece& piece) {
  return std::max({distance(ball.center, piece.corners[0]), distance(ball.center, piece.corners[1]),
                   distance(ball.center, piece.corners[2])});
}

/// A piece and the balls that hold it, ascending.
struct HeldPiece {
  Piece piece;
  Vec3d centroid;
  std::vector<std::uint32_t> holders;

  bool heldBy(std::uint32_t ball) const { return std::ranges::binary_search(holders, ball); }
};

HeldPiece heldPiece(const Piece& piece, std::span<const Ball> balls) {
  HeldPiece held{piece, centroidOf(piece), {}};
  for (std::uint32_t i = 0; i < balls.size(); ++i)
    if (reachOf(balls[i], piece) <= balls[i].radius * kSlack) held.holders.push_back(i);
  return held;
}

/// The ball that needs to grow least to hold a piece; if some hold it, the one that holds it deepest.
std::size_t leastGrowth(std::span<const Ball> balls, const Piece& piece) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < balls.size(); ++i)
    if (reachOf(balls[i], piece) - balls[i].radius < reachOf(balls[best], piece) - balls[best].radius) best = i;
  return best;
}

/// The planes between pairs of balls. The side of ball `a` of the pair a < b is where the distance along the line from
/// a to b is below the pair's offset.
class Planes {
 public:
  Planes(std::span<const Ball> balls, std::span<const HeldPiece> pieces)
      : balls_(balls), offsets_(balls.size() * balls.size()) {
    for (std::uint32_t a = 0; a < balls.size(); ++a)
      for (std::uint32_t b = a + 1; b < balls.size(); ++b) offsets_[a * balls.size() + b] = balanced(a, b, pieces);
  }

  /// True when the point is on the side of ball `mine` of its plane to ball `other`.
  bool onSideOf(std::uint32_t mine, std::uint32_t other, const Vec3d& point) const {
    const std::uint32_t a = std::min(mine, other), b = std::max(mine, other);
    return (along(a, b, point) < offsets_[a * balls_.size() + b]) == (mine == a);
  }

 private:
  double along(std::uint32_t a, std::uint32_t b, const Vec3d& point) const {
    const Vec3d line = balls_[b].center - balls_[a].center;
    const double length = cairn::length(line);
    return length > 0 ? dot(point - balls_[a].center, line) / length : 0;
  }

  /// The plane through the circle in which the surfaces meet (the formula in 6.1).
  double intersection(std::uint32_t a, std::uint32_t b) const {
    const double apart = distance(balls_[a].center, balls_[b].center);
    if (!(apart > 0)) return 0;
    const double ra = balls_[a].radius, rb = balls_[b].radius;
    return 0.5 * (apart + (ra * ra - rb * rb) / apart);
  }

  /// The offset that balances the numbers of pieces best. Among equal ones, the nearest to the intersection.
  double balanced(std::uint32_t a, std::uint32_t b, std::span<const HeldPiece> pieces) const {
    std::ptrdiff_t onlyA = 0, onlyB = 0;
    std::vector<double> shared;
    for (const HeldPiece& p : pieces) {
      const bool inA = p.heldBy(a), inB = p.heldBy(b);
      if (inA && inB)
        shared.push_back(along(a, b, p.centroid));
      else if (inA)
        ++onlyA;
      else if (inB)
        ++onlyB;
    }
    const double start = intersection(a, b);
    if (shared.empty()) return start;
    std::ranges::sort(shared);
    const std::ptrdiff_t all = std::ssize(shared), wanted = (onlyB + all - onlyA) / 2;  // of the shared ones, to a
    const std::ptrdiff_t toA = std::clamp(wanted, std::ptrdiff_t{0}, all);
    if (toA == 0) return std::min(start, shared.front());
    if (toA == all) return std::max(start, std::nextafter(shared.back(), 2 * std::abs(shared.back()) + 1));
    return std::clamp(start, std::nextafter(shared[toA - 1], shared[toA]), shared[toA]);
  }

  std::span<const Ball> balls_;
  std::vector<double> offsets_;  // by a, then b
};

std::size_t ownerOf(const HeldPiece& held, const Planes& planes, std::span<const Ball> balls) {
  for (const std::uint32_t mine : held.holders)
    if (std::ranges::all_of(held.holders, [&](std::uint32_t other) {
          return other == mine || planes.onSideOf(mine, other, held.centroid);
        }))
      return mine;
  return leastGrowth(balls, held.piece);
}

}  // namespace

std::vector<Pieces> divideByPlanes(Pieces pieces, std::span<const Ball> balls, double finest) {
  assert(!balls.empty() && finest > 0);
  std::vector<HeldPiece> held;
  while (!pieces.empty()) {
    HeldPiece next = heldPiece(pieces.back(), balls);
    pieces.pop_back();
    if (next.holders.empty() && longestEdgeSq(next.piece) > finest * finest) {
      const std::array<Piece, 2> halves = bisect(next.piece);
      pieces.push_back(halves[1]);
      pieces.push_back(halves[0]);
    } else {
      held.push_back(std::move(next));
    }
  }
  const Planes planes(balls, held);
  std::vector<Pieces> parts(balls.size());
  for (const HeldPiece& piece : held) parts[ownerOf(piece, planes, balls)].push_back(piece.piece);
  return parts;
}

}  // namespace cairn::builder
