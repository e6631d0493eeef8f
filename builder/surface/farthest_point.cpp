// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/farthest_point.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <vector>

namespace cairn::builder {
namespace {

struct Piece {
  std::array<Vec3d, 3> corners;
  double upper = 0;  ///< no point of the piece is farther

  /// Orders a heap with the largest bound on top.
  friend bool operator<(const Piece& a, const Piece& b) { return a.upper < b.upper; }
};

class Search {
 public:
  Search(const TriangleMesh& from, const SurfaceDistance& to, const FarthestTolerance& tolerance)
      : from_(from), to_(to), tolerance_(tolerance) {}

  FarthestPoint run() {
    for (const Vec3d& vertex : from_.vertices) offer(vertex, to_.closest(vertex).distance);
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < from_.triangles.size(); ++t) push({from_.corners(t), kUnknown});
    const std::uint64_t first = queries_;
    while (!pieces_.empty() && !closeEnough(pieces_.front().upper) && queries_ - first < tolerance_.maxQueries) split();
    // The guard covers the queries, and the rounding of the pieces' corners by a few units of their coordinates.
    const Bounds bounds = boundsOf(from_);
    const double guard = 2 * std::max(distanceRoundingBound(to_.bounds(), bounds.lower),
                                      distanceRoundingBound(to_.bounds(), bounds.upper));
    result_.upper = std::max(best_, pieces_.empty() ? 0 : pieces_.front().upper) + guard;
    result_.lower = std::max(0.0, best_ - guard);
    return result_;
  }

 private:
  bool closeEnough(double upper) const { return upper <= best_ * (1 + tolerance_.relative) + tolerance_.absolute; }

  void offer(const Vec3d& point, double distance) {
    if (!(distance > best_)) return;
    best_ = distance;
    result_.witness = point;
  }

  /// Bounds a piece by one query, and keeps it if it may hold a point farther than the witness.
  void push(Piece piece) {
    const auto& [a, b, c] = piece.corners;
    const Vec3d middle = (a + b + c) / 3.0;
    ++queries_;
    const SurfaceDistance::Nearest nearest = to_.closest(middle);
    offer(middle, nearest.distance);
    double toTriangle = 0;
    for (const Vec3d& corner : piece.corners)
      toTriangle = std::max(toTriangle, to_.distanceToTriangle(nearest.triangle, corner));
    piece.upper = std::min(piece.upper, toTriangle);
    if (piece.upper <= best_) return;
    pieces_.push_back(piece);
    std::push_heap(pieces_.begin(), pieces_.end());
  }

  void split() {
    std::pop_heap(pieces_.begin(), pieces_.end());
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    const auto& [a, b, c] = piece.corners;
    const Vec3d ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    push({{a, ab, ca}, piece.upper});
    push({{b, bc, ab}, piece.upper});
    push({{c, ca, bc}, piece.upper});
    push({{ab, bc, ca}, piece.upper});
  }

  const TriangleMesh& from_;
  const SurfaceDistance& to_;
  FarthestTolerance tolerance_;
  double best_ = 0;
  std::uint64_t queries_ = 0;
  std::vector<Piece> pieces_;
  FarthestPoint result_;
};

}  // namespace

FarthestPoint farthestPoint(const TriangleMesh& from, const SurfaceDistance& to, const FarthestTolerance& tolerance) {
  assert(!from.triangles.empty());
  return Search(from, to, tolerance).run();
}

}  // namespace cairn::builder
