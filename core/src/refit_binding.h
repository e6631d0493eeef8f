// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "refit_parts.h"

namespace cairn {

/// What a tree's nodes hold on to when vertices move. Places are numbered: the vertices first, then `fixed`.
struct RefitBinding {
  /// Of one node, as it was at first.
  struct Node {
    Vec3d middle;                  ///< of its places
    double weightOfNormals = 0;    ///< of a triangle's normal beside a place, for each unit of its area
    std::uint32_t nearest = 0;     ///< a triangle that is nearest to its centre
    std::uint32_t firstPlace = 0;  ///< into `placesOfNodes`, up to the next node's
  };
  std::vector<FixedPlace> fixed;
  std::vector<std::uint32_t> placesOfNodes;
  std::vector<Node> nodes;                  ///< by record, and one that ends the last
  std::vector<std::uint32_t> support;       ///< the place of each support point
  std::vector<std::uint32_t> faceOfNormal;  ///< of each face normal, the triangle that faced along it best
  std::vector<Vec3d> places;                ///< where each was
  std::vector<double> areas;                ///< of the triangles

  /// The numbers of a node's places: its ball holds them.
  std::span<const std::uint32_t> placesOf(std::uint32_t record) const {
    const std::uint32_t first = nodes[record].firstPlace;
    return std::span(placesOfNodes).subspan(first, nodes[record + 1].firstPlace - first);
  }
  /// Where all places are when the vertices are there. `out` has their number.
  void move(const SphereTree& tree, std::span<const Vec3> vertices, std::span<Vec3d> out) const;
};

/// The place of a triangle near a point of it, or near one close to it.
FixedPlace placeOn(const SphereTree& tree, std::uint32_t triangle, const Vec3d& point);
/// Where the place is while the tree's vertices are where they are.
Vec3d whereIs(const SphereTree& tree, const FixedPlace& place);

/// Precondition: every triangle is listed by a leaf.
RefitBinding bindTree(const SphereTree& tree);

}  // namespace cairn
