// SPDX-License-Identifier: GPL-3.0-or-later
#include "piece.h"

#include <algorithm>
#include <bit>
#include <queue>
#include <tuple>
#include <utility>

namespace cairn::builder {

namespace {

double edgeLengthSq(const Piece& piece, std::size_t first) {
  return lengthSq(piece.corners[(first + 1) % 3] - piece.corners[first]);
}

struct QueuedPiece {
  double edgeSq;
  std::size_t index;

  friend bool operator<(const QueuedPiece& a, const QueuedPiece& b) {
    return a.edgeSq != b.edgeSq ? a.edgeSq < b.edgeSq : a.index > b.index;
  }
};

}  // namespace

double longestEdgeSq(const Piece& piece) {
  return edgeLengthSq(piece, longestEdge(piece));
}

double areaOf(const Piece& piece) {
  return 0.5 * length(cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0]));
}

Vec3d centroidOf(const Piece& piece) {
  return (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
}

std::size_t longestEdge(const Piece& piece) {
  std::size_t longest = 0;
  double mostSq = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double edgeSq = edgeLengthSq(piece, i);
    if (edgeSq > mostSq) {
      mostSq = edgeSq;
      longest = i;
    }
  }
  return longest;
}

std::array<Piece, 2> cutAt(const Piece& piece, std::size_t first) {
  const std::size_t second = (first + 1) % 3;
  const Vec3d middle = (piece.corners[first] + piece.corners[second]) * 0.5;
  std::array<Piece, 2> halves{piece, piece};
  halves[0].corners[second] = middle;
  halves[1].corners[first] = middle;
  return halves;
}

std::array<Piece, 2> bisect(const Piece& piece) {
  return cutAt(piece, longestEdge(piece));
}

Pieces piecesOf(const TriangleMesh& mesh) {
  Pieces pieces(mesh.triangles.size());
  for (std::uint32_t t = 0; t < pieces.size(); ++t) pieces[t] = {mesh.corners(t), t};
  return pieces;
}

void refinePieces(Pieces& pieces, std::size_t count) {
  if (pieces.empty() || pieces.size() >= count) return;
  std::priority_queue<QueuedPiece> queue;
  for (std::size_t i = 0; i < pieces.size(); ++i) queue.push({longestEdgeSq(pieces[i]), i});
  while (pieces.size() < count) {
    const std::size_t index = queue.top().index;
    queue.pop();
    const std::array<Piece, 2> halves = bisect(pieces[index]);
    pieces[index] = halves[0];
    pieces.push_back(halves[1]);
    queue.push({longestEdgeSq(halves[0]), index});
    queue.push({longestEdgeSq(halves[1]), pieces.size() - 1});
  }
}

namespace {

/// A list of points without repetitions. Of zeros with different signs, the first one stays.
class DistinctPoints {
 public:
  explicit DistinctPoints(std::size_t most)
      : shift_(64 - std::bit_width(2 * most)), slots_(std::size_t{1} << (64 - shift_), kFree) {
    points_.reserve(most);
  }

  void add(const Vec3d& point) {
    std::size_t slot = hashOf(point) >> shift_;
    while (slots_[slot] != kFree) {
      if (points_[slots_[slot]] == point) return;
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }

  std::vector<Vec3d> take() { return std::move(points_); }

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};

  static std::uint64_t hashOf(const Vec3d& point) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
      hash =
          (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(point[axis] + 0.0)) * 0x9e3779b97f4a7c15;  // 2^64 / phi
    return hash;
  }

  int shift_;
  std::vector<std::uint32_t> slots_;  // at most half of them are taken
  std::vector<Vec3d> points_;
};

}  // namespace

std::vector<Vec3d> cornersOf(std::span<const Piece> pieces) {
  // Most corners belong to several pieces, so the removal of repetitions first saves most of the sorting.
  DistinctPoints distinct(3 * pieces.size() + 1);
  for (const Piece& piece : pieces)
    for (const Vec3d& corner : piece.corners) distinct.add(corner);
  std::vector<Vec3d> corners = distinct.take();
  std::sort(corners.begin(), corners.end(),
            [](const Vec3d& a, const Vec3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return corners;
}

}  // namespace cairn::builder
