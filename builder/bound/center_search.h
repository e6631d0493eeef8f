// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// A cube of centres; with half edge 0 a single centre.
struct CenterCell {
  Vec3d center;
  double half = 0;
};

/// An upper bound of the weight that balls with centres in one cell hold together.
struct HeavyCell {
  CenterCell cell;
  std::uint64_t load = 0;  ///< weight of the points that no outside point excludes
};

/// Finds the sets of surface points that one ball can hold without an outside point.
///
/// A ball around c that holds p but not q has |p - c| < |q - c|. So c lies on p's side of the plane midway between p
/// and q. A ball with its centre in a cube cannot hold p if some q has the whole cube on its own side. This test is the
/// sign of a linear function at the corners of the cube. Every test carries a guard, so that an exclusion also holds
/// for the exact points.
///
/// All positions are relative to one origin. The cubes' corners are exact binary fractions.
///
///     CenterSearch search(points, outside, half, displacement);
///     bool proved = search.heavierThan(weights, most, finest, keepGoing).value().empty();
class CenterSearch {
 public:
  /// `half`: no relevant centre and no point is farther than this from the origin along an axis. `displacement`: upper
  /// bound of the distance from any point to the exact point it represents. Once `keepGoing` returns false, the
  /// construction ends, and every later search finds nothing out.
  CenterSearch(std::vector<Vec3d> points, std::vector<Vec3d> outside, double half, double displacement,
               const KeepGoing& keepGoing);

  /// Adds a point that no ball may hold. False when the point lies beyond `half` and is ignored. Cheap; it makes all
  /// later answers tighter.
  bool addOutside(const Vec3d& point);

  /// Searches all centres for balls that may hold points of a total weight above `most`. An empty result proves that
  /// there are none. Otherwise the result has the heaviest few of each part of space. Some are single centres: the
  /// largest ball that the outside points allow there does hold this weight. The others are cells with a half edge of
  /// at most `finest`. Nothing when it was told to stop, by `keepGoing` or during the construction. Parallel,
  /// deterministic.
  std::optional<std::vector<HeavyCell>> heavierThan(std::span<const std::uint64_t> weights, std::uint64_t most,
                                                    double finest, const KeepGoing& keepGoing) const;

  /// Returns the points that balls with centres in the cell may hold, by the same test as `heavierThan`; ascending.
  /// Precondition: the cell comes from `heavierThan` or is a single centre.
  std::vector<std::uint32_t> pointsOf(const CenterCell& cell) const;
  /// Moves a centre away from its nearest outside point until a second one is equally near. The new ball holds all
  /// points of the former one.
  Vec3d grown(const Vec3d& center) const;

  std::span<const Vec3d> points() const { return points_; }
  std::span<const Vec3d> outside() const { return outside_; }

 private:
  /// A cell, the points its balls may hold, and the outside points that may exclude some of them.
  struct Node {
    CenterCell cell;
    std::vector<std::uint32_t> points, outside;
    double reach = 0;  ///< outside points farther than this from the centre exclude nothing here
  };
  struct Descent;

  /// Returns the node of `cell` within a larger one. `nearestSq` receives the squared distance of the nearest outside
  /// point.
  Node narrowed(const CenterCell& cell, std::span<const std::uint32_t> points, std::span<const std::uint32_t> outside,
                double* nearestSq = nullptr) const;
  /// False when it was told to stop.
  bool collect(const Node& node, int levels, const KeepGoing& keepGoing, std::vector<Node>& out) const;
  /// Returns the kept node that holds this centre; null when its balls hold no point.
  const Node* nodeAt(const Vec3d& center) const;

  std::vector<Vec3d> points_, outside_;
  double half_;
  double guard_;                            ///< for differences of squared lengths
  bool complete_ = true;                    ///< the construction was not stopped
  std::vector<Node> kept_;                  ///< in the order of their octants
  std::vector<std::uint32_t> keptOctants_;  ///< the path from the root, three bits a level
};

}  // namespace cairn::builder
