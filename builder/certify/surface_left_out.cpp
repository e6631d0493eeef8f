// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/builder/certify.h"
#include "certify/ball_distances.h"
#include "certify/left_out.h"

namespace cairn::builder {
namespace {

using Corners = std::array<Vec3d, 3>;

/// Triangles whose candidates are found together.
constexpr std::uint32_t kBlock = 32;

struct Circle {
  Vec3d middle;
  double reach = 0;
};

Circle around(std::span<const Vec3d> points) {
  Circle circle;
  for (const Vec3d& p : points) circle.middle += p - points[0];
  circle.middle = points[0] + circle.middle / static_cast<double>(points.size());
  for (const Vec3d& p : points) circle.reach = std::max(circle.reach, distance(p, circle.middle));
  return circle;
}

/// Lower and upper bound before the guard: `lower` may be negative, deep inside balls.
struct Bracket {
  double upper = 0, lower = 0;
  Vec3d witness;

  void offer(const Vec3d& point, double outside) {
    if (!(outside > lower)) return;
    lower = outside;
    witness = point;
  }
  static Bracket worse(const Bracket& a, const Bracket& b) {
    Bracket w = b.lower > a.lower ? b : a;
    w.upper = std::max(a.upper, b.upper);
    return w;
  }
};

/// The proof for triangles one after the other: depth-first over pieces, which are settled when they lie in one ball or
/// when they cannot hold a point noticeably farther than the worst known.
class TriangleSearch {
 public:
  TriangleSearch(const BallDistances& balls, const LeftOutTolerance& tolerance, double smallest, Bracket known)
      : balls_(balls), tolerance_(tolerance), smallest_(smallest), bracket_(known) {}

  void add(const Corners& piece, std::span<const std::uint32_t> candidates) {
    const double most = balls_.most(piece, candidates);
    if (most <= -balls_.guard()) return;
    const Circle circle = around(piece);
    BallDistances::Names near;
    bracket_.offer(circle.middle, balls_.gather(circle.middle, circle.reach, candidates, near));
    if (settled(most)) {
      bracket_.upper = std::max(bracket_.upper, most);
      return;
    }
    const int longest = longestEdge(piece);
    const Vec3d &a = piece[longest], &b = piece[(longest + 1) % 3], &c = piece[(longest + 2) % 3];
    if (distance(a, b) <= smallest_) {
      // Not known to be covered, however little it may lack.
      bracket_.upper = std::max({bracket_.upper, most, balls_.guard()});
      return;
    }
    const Vec3d half = (a + b) * 0.5;
    add({a, half, c}, near);
    add({half, b, c}, near);
  }

  const Bracket& bracket() const { return bracket_; }

 private:
  /// Where everything seen so far is covered, nothing short of cover will do.
  bool settled(double most) const {
    const double worst = bracket_.lower - balls_.guard();
    return worst > 0 && most <= worst * (1 + tolerance_.relative) + tolerance_.absolute;
  }
  static int longestEdge(const Corners& p) {
    const double edges[] = {lengthSq(p[1] - p[0]), lengthSq(p[2] - p[1]), lengthSq(p[0] - p[2])};
    return static_cast<int>(std::max_element(edges, edges + 3) - edges);
  }

  const BallDistances& balls_;
  const LeftOutTolerance& tolerance_;
  double smallest_;
  Bracket bracket_;
};

/// The worst vertex, known before any triangle is divided, so that no order of the work shows.
Bracket worstVertex(const BallDistances& balls, const TriangleMesh& mesh) {
  const auto search = [&](const tbb::blocked_range<std::size_t>& range, Bracket worst) {
    for (std::size_t v = range.begin(); v < range.end(); ++v)
      worst.offer(mesh.vertices[v], balls.nearest(mesh.vertices[v], balls.all()));
    return worst;
  };
  return tbb::parallel_deterministic_reduce(tbb::blocked_range<std::size_t>(0, mesh.vertices.size(), 512), Bracket{},
                                            search, Bracket::worse);
}

}  // namespace

EnclosedDistance surfaceLeftOut(std::span<const Ball> balls, const TriangleMesh& mesh,
                                const LeftOutTolerance& tolerance, const KeepGoing& keepGoing) {
  const BallDistances distances(balls, boundsOf(mesh));
  const double smallest = kMinPiece * boundsOf(mesh).diagonal();
  const Bracket known = worstVertex(distances, mesh);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto search = [&](const tbb::blocked_range<std::uint32_t>& blocks, Bracket worst) {
    for (std::uint32_t block = blocks.begin(); block < blocks.end() && keepGoing(); ++block) {
      const std::uint32_t begin = block * kBlock, end = std::min(count, begin + kBlock);
      std::vector<Vec3d> corners;
      for (std::uint32_t t = begin; t < end; ++t)
        for (const Vec3d& corner : mesh.corners(t)) corners.push_back(corner);
      const Circle circle = around(corners);
      BallDistances::Names near;
      distances.gather(circle.middle, circle.reach, distances.all(), near);
      TriangleSearch one(distances, tolerance, smallest, known);
      for (std::uint32_t t = begin; t < end; ++t) one.add(mesh.corners(t), near);
      worst = Bracket::worse(worst, one.bracket());
    }
    return worst;
  };
  const Bracket worst = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::uint32_t>(0, (count + kBlock - 1) / kBlock, 4), known, search, Bracket::worse);
  const double upper = std::max(worst.upper, worst.lower);
  return {upper > 0 ? upper + distances.guard() : 0, std::max(0.0, worst.lower - distances.guard()), worst.witness};
}

}  // namespace cairn::builder
