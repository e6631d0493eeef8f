// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "continuous/separating_normals.h"
#include "placement/placed_tree.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// A sphere-tree as it is swept, in *parts*: its nodes, and the source triangles of leaves whose error is too large. A
/// triangle part is named by its leaf and its index among the leaf's triangles.
///
///     const TreeParts parts(placedTree);
///     const TreeParts::Children children = parts.children(part, crude);
class TreeParts {
 public:
  using Part = std::uint32_t;
  /// Leaves of more triangles are not split, because no budget covers their tests.
  static constexpr std::uint32_t kMaxTriangles = 64;

  struct Children {
    Part first = 0;
    std::uint32_t count = 0;
  };

  TreeParts() = default;
  explicit TreeParts(const PlacedTree& tree) : tree_(tree) {}

  const SphereTree& tree() const { return tree_.tree(); }
  float scale() const { return tree_.scale(); }

  static bool isTriangle(Part part) { return (part & kTriangleBit) != 0; }
  /// The node itself, or the leaf of a triangle.
  static NodeId nodeOf(Part part) { return isTriangle(part) ? (part & ~kTriangleBit) / kMaxTriangles : part; }
  /// The triangle's index among those of its leaf.
  static std::uint32_t indexOf(Part part) { return part % kMaxTriangles; }

  /// Empty for a triangle, and for a leaf that is within `crude` (world length, certified) of its surface or names its
  /// faces.
  Children children(Part part, float crude) const;
  /// The triangle of a triangle part. The frame of this and all below is that of the `PlacedTree`, world unit.
  Triangle triangle(Part part) const;
  /// A ball around the part.
  Sphere sphere(Part part) const;
  /// The part's point that lies farthest along `direction`.
  Vec3 support(Part part, const Vec3& direction) const;
  /// Appends the normals of a part's faces, or the middle of the normals of a part in one plane. Both signs: a body
  /// behind a flat region is apart from it along the opposite normal.
  void appendFaces(Part part, SeparatingNormals& normals) const;

 private:
  static constexpr Part kTriangleBit = 1U << 31;

  bool isCrude(NodeId leaf, float crude) const;

  PlacedTree tree_;
};

}  // namespace cairn::bullet
