// SPDX-License-Identifier: GPL-3.0-or-later
#include "certify/cover_proof.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::builder {
namespace {

double largestCoordinate(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

CoverProof::CoverProof(const SphereTree& tree, const TriangleMesh& mesh) : tree_(tree), mesh_(mesh) {
  smallestPiece_ = kMinPiece * boundsOf(mesh).diagonal();
  double reach = 0;
  for (const Vec3d& v : mesh.vertices) reach = std::max(reach, largestCoordinate(toTree(v)));
  for (const NodeData& node : tree.data().nodes)
    reach = std::max(reach, largestCoordinate(Vec3d(node.center)) + static_cast<double>(node.radius));
  // Let u = 2^-53, and every coordinate at most `reach`. A corner minus the origin rounds by u reach, and each halving
  // of an edge rounds by u reach too. Longest-edge bisection needs at most 52 halvings (edges shrink below sqrt(3)
  // 2^(-n/2), Adler 1983). A corner minus a centre rounds by 2 u reach. Squares, sum and the comparison round by 8 u of
  // the distance, which is below 4 reach. The total is less than 100 u reach for each coordinate, times sqrt(3) for the
  // vector. So 2^-45 = 256 u covers it, with room for the arithmetic of the radii here.
  guard_ = 0x1p-45 * reach;
  balls_.resize(std::size_t{kFamilyWidth} * tree.families().size());
  for (std::uint32_t i = 0; i < tree.nodeCount(); ++i) {
    const NodeData& node = tree.data().nodes[i];
    const double inner = static_cast<double>(node.radius) - guard_;
    balls_[tree.nodeAt(i)] = {Vec3d(node.center), node.radius, inner >= 0 ? inner * inner : -1};
  }
}

/// The proof for one triangle, depth-first over its pieces. Each piece carries the nodes that may still hold it or a
/// part of it.
class CoverProof::Search {
 public:
  Search(const CoverProof& proof, std::uint32_t level, bool descend)
      : proof_(proof), level_(level), descend_(descend) {}

  /// Returns the middle of the first piece without a proof; nothing when all are proved.
  std::optional<Vec3d> unproved(const Piece& piece, const std::vector<NodeId>& candidates) {
    std::vector<NodeId> partial;
    if (held(piece, candidates, partial)) return std::nullopt;
    const Vec3d middle = (piece[0] + piece[1] + piece[2]) / 3;
    const int longest = longestEdge(piece);
    const Vec3d &a = piece[longest], &b = piece[(longest + 1) % 3], &c = piece[(longest + 2) % 3];
    if (partial.empty() || distance(a, b) <= proof_.smallestPiece_) return middle;
    const Vec3d half = (a + b) * 0.5;
    if (auto point = unproved({a, half, c}, partial)) return point;
    return unproved({half, b, c}, partial);
  }

 private:
  static int longestEdge(const Piece& p) {
    const double edges[] = {lengthSq(p[1] - p[0]), lengthSq(p[2] - p[1]), lengthSq(p[0] - p[2])};
    return static_cast<int>(std::max_element(edges, edges + 3) - edges);
  }

  bool isEnd(NodeId node) const { return !descend_ || proof_.tree_.isLeaf(node) || proof_.tree_.level(node) == level_; }

  /// True when one chain of balls holds the whole piece. Otherwise `partial` gets the nodes that hold at most a part of
  /// it. The search for its parts continues in or below these nodes.
  bool held(const Piece& piece, const std::vector<NodeId>& candidates, std::vector<NodeId>& partial) {
    stack_ = candidates;
    const Vec3d middle = (piece[0] + piece[1] + piece[2]) / 3;
    const double reach =
        std::sqrt(std::max({lengthSq(piece[0] - middle), lengthSq(piece[1] - middle), lengthSq(piece[2] - middle)}));
    while (!stack_.empty()) {
      const NodeId node = stack_.back();
      stack_.pop_back();
      const GuardedBall& ball = proof_.balls_[node];
      const bool whole = std::all_of(piece.begin(), piece.end(),
                                     [&](const Vec3d& p) { return lengthSq(p - ball.center) <= ball.innerSq; });
      if (whole && isEnd(node)) return true;
      if (whole) {
        const std::uint32_t family = proof_.tree_.childFamily(node);
        for (std::uint32_t lane = 0; lane < proof_.tree_.familySize(family); ++lane)
          stack_.push_back(family * kFamilyWidth + lane);
      } else {
        const double touch = ball.radius + reach + proof_.guard_;
        if (lengthSq(middle - ball.center) <= touch * touch) partial.push_back(node);
      }
    }
    return false;
  }

  const CoverProof& proof_;
  std::uint32_t level_;
  bool descend_;
  std::vector<NodeId> stack_;
};

std::optional<UncoveredPiece> CoverProof::firstFailure(const std::vector<NodeId>& start, std::uint32_t level,
                                                       bool descend) const {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Failure {
    std::uint32_t triangle = kNone;
    Vec3d point;
  };
  const auto lower = [](const Failure& a, const Failure& b) { return b.triangle < a.triangle ? b : a; };
  const auto search = [&](const tbb::blocked_range<std::uint32_t>& range, Failure failure) {
    Search one(*this, level, descend);
    for (std::uint32_t t = range.begin(); t < range.end() && failure.triangle == kNone; ++t) {
      const auto corners = mesh_.corners(t);
      const Piece piece{toTree(corners[0]), toTree(corners[1]), toTree(corners[2])};
      if (const auto point = one.unproved(piece, start)) failure = {t, *point};
    }
    return failure;
  };
  const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
  const Failure failure =
      tbb::parallel_reduce(tbb::blocked_range<std::uint32_t>(0, count, 64), Failure{}, search, lower);
  if (failure.triangle == kNone) return std::nullopt;
  double gap = std::numeric_limits<double>::infinity();
  for (const NodeId node : tree_.levelCut(level)) {
    double outside = distance(failure.point, balls_[node].center) - balls_[node].radius;
    for (std::uint32_t i = tree_.node(node).parent; descend && node != kRootNode; i = tree_.data().nodes[i].parent) {
      const GuardedBall& ancestor = balls_[tree_.nodeAt(i)];
      outside = std::max(outside, distance(failure.point, ancestor.center) - ancestor.radius);
      if (i == 0) break;
    }
    gap = std::min(gap, outside);
  }
  return UncoveredPiece{failure.triangle, failure.point + tree_.origin(), gap};
}

std::optional<UncoveredPiece> CoverProof::unreachable(std::uint32_t level) const {
  return firstFailure({kRootNode}, level, true);
}

std::optional<UncoveredPiece> CoverProof::uncovered(std::uint32_t level) const {
  return firstFailure(tree_.levelCut(level), level, false);
}

}  // namespace cairn::builder
