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
  const std::size_t count = tree.spheresPerNode();
  balls_.resize(kFamilyWidth * tree.families().size() * count);
  double reach = 0;
  for (const Vec3d& v : mesh.vertices) reach = std::max(reach, largestCoordinate(toTree(v)));
  for (std::uint32_t i = 0; i < tree.nodeCount(); ++i) {
    const NodeId node = tree.nodeAt(i);
    const Sphere both[] = {tree.sphere(node), tree.bound(node)};
    for (std::size_t k = 0; k < count; ++k) {
      reach = std::max(reach, largestCoordinate(Vec3d(both[k].center)) + static_cast<double>(both[k].radius));
      balls_[node * count + k] = {Vec3d(both[k].center), both[k].radius};
    }
  }
  // Let u = 2^-53, and every coordinate at most `reach`. A corner minus the origin rounds by u reach, and each halving
  // of an edge rounds by u reach too. Longest-edge bisection needs at most 52 halvings (edges shrink below sqrt(3)
  // 2^(-n/2), Adler 1983). A corner minus a centre rounds by 2 u reach. Squares, sum and the comparison round by 8 u of
  // the distance, which is below 4 reach. The total is less than 100 u reach for each coordinate, times sqrt(3) for the
  // vector. So 2^-45 = 256 u covers it, with room for the arithmetic of the radii here.
  guard_ = 0x1p-45 * reach;
  for (GuardedBall& ball : balls_) {
    const double inner = ball.radius - guard_;
    ball.innerSq = inner >= 0 ? inner * inner : -1;
  }
}

double CoverProof::outside(NodeId node, const Vec3d& point) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const GuardedBall& ball : ballsOf(node)) most = std::max(most, distance(point, ball.center) - ball.radius);
  return most;
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
      const std::span<const GuardedBall> balls = proof_.ballsOf(node);
      const bool whole = std::ranges::all_of(balls, [&](const GuardedBall& ball) {
        return std::ranges::all_of(piece, [&](const Vec3d& p) { return lengthSq(p - ball.center) <= ball.innerSq; });
      });
      if (whole && isEnd(node)) return true;
      if (whole) {
        const std::uint32_t family = proof_.tree_.childFamily(node);
        for (std::uint32_t lane = 0; lane < proof_.tree_.familySize(family); ++lane)
          stack_.push_back(family * kFamilyWidth + lane);
      } else {
        const bool touches = std::ranges::all_of(balls, [&](const GuardedBall& ball) {
          const double touch = ball.radius + reach + proof_.guard_;
          return lengthSq(middle - ball.center) <= touch * touch;
        });
        if (touches) partial.push_back(node);
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
    double ofChain = outside(node, failure.point);
    for (std::uint32_t i = tree_.node(node).parent; descend && node != kRootNode; i = tree_.data().nodes[i].parent) {
      ofChain = std::max(ofChain, outside(tree_.nodeAt(i), failure.point));
      if (i == 0) break;
    }
    gap = std::min(gap, ofChain);
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
