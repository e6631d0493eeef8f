// SPDX-License-Identifier: GPL-3.0-or-later
#include "divide_among_leaves.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace cairn::builder {

namespace {

/// Factor on a level's limit up to which a piece is not bisected. The balls were fitted to points, and the surface
/// between points needs a little more.
constexpr double kSeamAllowance = 1.01;
/// Pieces are bisected down to this fraction of the leaves' limit. The rest of a seam costs its width times the sine of
/// the angle between the balls and the surface.
constexpr double kFinestSeam = 0.2;
constexpr std::size_t kChunks = 64;

/// Balls by level and the children of each.
class BallTree {
 public:
  explicit BallTree(std::span<const CoverLevel> levels) : levels_(levels), children_(levels.size()) {
    for (std::size_t l = 0; l < levels.size(); ++l) {
      children_[l].resize(l == 0 ? 1 : levels[l - 1].balls.size());
      for (std::uint32_t i = 0; i < levels[l].balls.size(); ++i) children_[l][levels[l].balls[i].parent].push_back(i);
    }
  }

  std::span<const std::uint32_t> children(std::size_t level, std::size_t parent) const {
    return children_[level][parent];
  }
  std::size_t leafLevel() const { return levels_.size() - 1; }
  const CoverLevel& level(std::size_t l) const { return levels_[l]; }
  std::size_t leaves() const { return levels_.back().balls.size(); }

 private:
  std::span<const CoverLevel> levels_;
  std::vector<std::vector<std::vector<std::uint32_t>>> children_;  // by level, by ball of the level above
};

/// The leaf that would take a piece.
struct Home {
  std::uint32_t leaf = 0;
  double cost = std::numeric_limits<double>::infinity();    // at the leaf
  double strain = std::numeric_limits<double>::infinity();  // largest ratio of cost and limit over the chain

  bool fits() const { return strain <= kSeamAllowance; }
};

class Homes {
 public:
  explicit Homes(const BallTree& tree) : tree_(tree) {}

  /// Returns the cheapest leaf whose whole chain holds the piece. With `force` and without such a leaf, returns the one
  /// of least strain.
  Home of(const Piece& piece, bool force) const {
    Home best;
    visit(piece, 0, 0, 0, force, best);
    return best;
  }

 private:
  void visit(const Piece& piece, std::size_t level, std::size_t parent, double strain, bool force, Home& best) const {
    const double limit = tree_.level(level).limit;
    for (const std::uint32_t i : tree_.children(level, parent)) {
      const double cost = costOf(tree_.level(level).balls[i].ball, piece);
      const double here = std::max(strain, cost / limit);
      if (here > kSeamAllowance && (!force || here >= best.strain)) continue;
      if (level < tree_.leafLevel()) {
        visit(piece, level + 1, i, here, force, best);
        continue;
      }
      const Home home{i, cost, here};
      if (home.fits() ? !best.fits() || cost < best.cost : here < best.strain) best = home;
    }
  }

  const BallTree& tree_;
};

/// The pieces by leaf.
std::vector<Pieces> divideChunk(std::span<const Piece> chunk, const BallTree& tree, double finest) {
  const Homes homes(tree);
  std::vector<Pieces> parts(tree.leaves());
  Pieces left(chunk.begin(), chunk.end());
  while (!left.empty()) {
    const Piece piece = left.back();
    left.pop_back();
    const bool force = longestEdgeSq(piece) <= finest * finest;
    const Home home = homes.of(piece, force);
    if (force || home.fits()) {
      parts[home.leaf].push_back(piece);
      continue;
    }
    const std::array<Piece, 2> halves = bisect(piece);
    left.push_back(halves[1]);
    left.push_back(halves[0]);
  }
  return parts;
}

std::vector<Pieces> divide(const Pieces& pieces, const BallTree& tree) {
  const double finest = kFinestSeam * tree.level(tree.leafLevel()).limit;
  std::vector<std::vector<Pieces>> chunks(kChunks);
  tbb::parallel_for(std::size_t{0}, kChunks, [&](std::size_t c) {
    const std::size_t begin = pieces.size() * c / kChunks, end = pieces.size() * (c + 1) / kChunks;
    chunks[c] = divideChunk(std::span(pieces).subspan(begin, end - begin), tree, finest);
  });
  std::vector<Pieces> parts(tree.leaves());
  for (const std::vector<Pieces>& chunk : chunks)
    for (std::size_t leaf = 0; leaf < parts.size(); ++leaf)
      parts[leaf].insert(parts[leaf].end(), chunk[leaf].begin(), chunk[leaf].end());
  return parts;
}

/// By level, by ball: the pieces of its leaves.
std::vector<std::vector<Pieces>> piecesByLevel(std::vector<Pieces> leaves, std::span<const CoverLevel> levels) {
  std::vector<std::vector<Pieces>> parts(levels.size());
  parts.back() = std::move(leaves);
  for (std::size_t l = levels.size() - 1; l > 0; --l) {
    parts[l - 1].resize(levels[l - 1].balls.size());
    for (std::size_t i = 0; i < parts[l].size(); ++i) {
      Pieces& parent = parts[l - 1][levels[l].balls[i].parent];
      parent.insert(parent.end(), parts[l][i].begin(), parts[l][i].end());
    }
  }
  return parts;
}

}  // namespace

RegionTree divideAmongLeaves(Region root, std::span<const CoverLevel> levels, const SignedDistance& solid) {
  const BallTree balls(levels);
  std::vector<std::vector<Pieces>> parts = piecesByLevel(divide(root.pieces, balls), levels);
  RegionTree tree;
  tree.push_back({std::move(root), 0, 0, 0});
  std::vector<std::uint32_t> ballOf{0};  // by node of the last level
  std::size_t first = 0;                 // node of the last level
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const std::size_t end = tree.size();
    std::vector<std::uint32_t> next;
    for (std::size_t node = first; node < end; ++node) {
      tree[node].firstChild = static_cast<std::uint32_t>(tree.size());
      for (const std::uint32_t i : balls.children(l, ballOf[node - first])) {
        if (parts[l][i].empty()) continue;
        tree.push_back({{}, static_cast<std::uint32_t>(node), 0, 0});
        next.push_back(i);
      }
      tree[node].childCount = static_cast<std::uint32_t>(tree.size()) - tree[node].firstChild;
    }
    tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t k) {
      tree[end + k].region = fittedRegion(levels[l].balls[next[k]].ball, std::move(parts[l][next[k]]), solid);
    });
    first = end;
    ballOf = std::move(next);
  }
  return tree;
}

}  // namespace cairn::builder
