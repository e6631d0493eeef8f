// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A cube of centres; with half edge 0 a single centre.
struct CenterCell {
  Vec3d center;
  double half = 0;
};

/// What the balls with centres in one cell may hold together: the points no outside point keeps from them.
struct HeavyCell {
  CenterCell cell;
  std::uint64_t load = 0;
};

/// Answers which sets of surface points one ball can hold without holding an outside point.
///
/// A ball around c that holds p but not q has |p - c| < |q - c|: c lies on p's side of the plane midway between p and
/// q. So the balls with centres in a cube can hold p only if no q has the whole cube on its own side, and that is a
/// linear function's sign at the corners of a cube. Every test carries a guard, so that what it excludes is excluded
/// for the exact points too.
///
/// All positions are relative to one origin; the cubes' corners are exact binary fractions.
class CenterSearch {
 public:
  /// `half`: no centre that matters, and none of the points, is farther than this from the origin along an axis.
  /// `displacement`: how far any point may be from the exact one it stands for.
  CenterSearch(std::vector<Vec3d> points, std::vector<Vec3d> outside, double half, double displacement);

  /// Another point no ball may hold; false when it is passed over because it lies beyond `half`. Cheap; sharpens all
  /// later answers.
  bool addOutside(const Vec3d& point);

  /// All centres are searched for balls that may hold points of weights above `most`. None found is a proof that there
  /// are none. What is found is the heaviest few of each part of space: single centres whose ball, as large as the
  /// outside points allow, does hold as much, and cells of at most `finest` half an edge. Parallel, deterministic.
  std::vector<HeavyCell> heavierThan(std::span<const std::uint64_t> weights, std::uint64_t most, double finest) const;

  /// The points of balls with centres in the cell, as `heavierThan` understands it; ascending. Precondition: the cell
  /// is one `heavierThan` returned, or a single centre.
  std::vector<std::uint32_t> pointsOf(const CenterCell& cell) const;
  /// Moves a centre away from its nearest outside point until a second one is as near: its ball then holds all the
  /// former one held.
  Vec3d grown(const Vec3d& center) const;

  std::span<const Vec3d> points() const { return points_; }
  std::span<const Vec3d> outside() const { return outside_; }

 private:
  /// A cell with the points its balls may hold and the outside points that may matter there.
  struct Node {
    CenterCell cell;
    std::vector<std::uint32_t> points, outside;
    double reach = 0;  ///< outside points farther than this from the centre exclude nothing here
  };
  struct Descent;

  /// The node of `cell` within a larger one; `nearestSq` receives the squared distance of the nearest outside point.
  Node narrowed(const CenterCell& cell, std::span<const std::uint32_t> points, std::span<const std::uint32_t> outside,
                double* nearestSq = nullptr) const;
  void collect(const Node& node, int levels, std::vector<Node>& out) const;
  /// The kept node that holds this centre; none when its balls hold no point.
  const Node* nodeAt(const Vec3d& center) const;

  std::vector<Vec3d> points_, outside_;
  double half_;
  double guard_;                            ///< on differences of squared lengths
  std::vector<Node> kept_;                  ///< by the order of their octants
  std::vector<std::uint32_t> keptOctants_;  ///< the path from the root, three bits a level
};

}  // namespace cairn::builder
