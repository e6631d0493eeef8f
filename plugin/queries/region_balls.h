// SPDX-License-Identifier: Zlib
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/sphere_tree.h"
#include "queries/segment.h"

namespace cairn::bullet {

/// Extends the tree below its leaves: balls around ever fewer of a leaf's source triangles, eight to a family. So a
/// cast does not test all triangles of a leaf it meets. A leaf of few triangles has no balls.
///
///     regions.visitTriangles(leaf, entries, end, [&](std::uint32_t triangle) { test(triangle); });
class RegionBalls {
 public:
  /// The tree must outlive this object. Cost: n log n in the triangles of all leaves. Memory: about 16 bytes for each
  /// triangle in leaves of more than `kAtOnce`.
  explicit RegionBalls(const SphereTree& tree);

  /// Moves the balls to another tree of the same triangles and regions, and refers to it from now on. Its triangles
  /// stay in the balls they are in. Cost: as many steps as there are triangles in all balls, one inside the other.
  void follow(const SphereTree& moved);

  /// Bytes this object holds.
  std::size_t memoryBytes() const {
    return sizeof *this + families_.capacity() * sizeof(Family) + parts_.capacity() * sizeof(Part) +
           (firstFamily_.capacity() + living_.capacity() + order_.capacity()) * sizeof(std::uint32_t);
  }

  /// Up to so many triangles are tested without balls.
  static constexpr std::uint32_t kAtOnce = 8;

  /// Calls `visit(triangle)` for the triangles of a leaf whose balls a cast meets. `entries` and `end` are as in
  /// `walkLeaves`, but `entries` gets a family and the bits of its living lanes.
  template <class EntriesOf, class End, class Visit>
  void visitTriangles(NodeId leaf, const EntriesOf& entries, const End& end, const Visit& visit) const {
    if (firstFamily_[leaf] == kNone) {
      for (const std::uint32_t triangle : tree_->regionTriangles(leaf)) visit(triangle);
      return;
    }
    visitFamily(firstFamily_[leaf], entries, end, visit);
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;
  // The content of one ball: triangles, or a family of smaller balls when `count` is 0.
  struct Part {
    std::uint32_t first = 0, count = 0;
  };

  template <class EntriesOf, class End, class Visit>
  void visitFamily(std::uint32_t family, const EntriesOf& entries, const End& end, const Visit& visit) const {
    const Entries found = entries(families_[family], living_[family], end());
    for (std::uint32_t lanes = found.lanes; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      if (found.at[lane] > end()) continue;
      const Part part = parts_[family * kFamilyWidth + lane];
      if (part.count == 0)
        visitFamily(part.first, entries, end, visit);
      else
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i) visit(order_[i]);
    }
  }

  std::uint32_t addFamily(Part whole);
  Part wholeOf(std::uint32_t family) const;
  std::uint32_t halve(Part* parts, std::uint32_t count);
  Sphere ballAround(Part part) const;
  Vec3 middle(std::uint32_t triangle) const;

  const SphereTree* tree_;
  std::vector<std::uint32_t> firstFamily_;  // by NodeId
  std::vector<Family> families_;
  std::vector<std::uint32_t> living_;  // by family
  std::vector<Part> parts_;            // by family and lane
  std::vector<std::uint32_t> order_;   // triangles
};

}  // namespace cairn::bullet
