// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/builder/certify.h"

namespace cairn::builder {

/// Proves that a mesh's surface lies in the balls of a tree. Of a node with two spheres the part that both share
/// counts, which is convex as a ball is. Keeps references; tree and mesh must outlive this object.
///
///     const CoverProof proof(tree, mesh);
///     const bool covers = !proof.unreachable(level);
class CoverProof {
 public:
  CoverProof(const SphereTree& tree, const TriangleMesh& mesh);

  /// Returns nothing when every point of every triangle lies in a ball of `levelCut(level)` and in all ancestors of
  /// that ball. Otherwise returns a piece, without such a proof, of the lowest-numbered failing triangle. Parallel,
  /// deterministic.
  std::optional<UncoveredPiece> unreachable(std::uint32_t level) const;

  /// Returns nothing when every point of every triangle lies in a ball of `levelCut(level)`. Otherwise returns a piece,
  /// without such a proof, of the lowest-numbered failing triangle. Parallel, deterministic.
  std::optional<UncoveredPiece> uncovered(std::uint32_t level) const;

 private:
  /// A ball in double precision and tree frame. The guard shrinks and grows it.
  struct GuardedBall {
    Vec3d center;
    double radius = 0;
    double innerSq = -1;  ///< a point within this computed squared distance is certainly in the ball
  };
  using Piece = std::array<Vec3d, 3>;  // tree frame
  class Search;

  std::optional<UncoveredPiece> firstFailure(const std::vector<NodeId>& start, std::uint32_t level, bool descend) const;
  Vec3d toTree(const Vec3d& meshPoint) const { return meshPoint - tree_.origin(); }
  std::span<const GuardedBall> ballsOf(NodeId node) const {
    const std::size_t count = tree_.spheresPerNode();
    return std::span(balls_).subspan(node * count, count);
  }
  /// Distance of a point from a node's balls, the farther one; negative inside both.
  double outside(NodeId node, const Vec3d& point) const;

  const SphereTree& tree_;
  const TriangleMesh& mesh_;
  double guard_ = 0;                // mesh unit
  double smallestPiece_ = 0;        // mesh unit
  std::vector<GuardedBall> balls_;  // by NodeId, one or two each
};

}  // namespace cairn::builder
