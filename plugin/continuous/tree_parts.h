// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "continuous/separating_normals.h"
#include "placement/placed_tree.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// A sphere-tree as it is swept: its *parts* are its nodes and, below leaves that say too little of where their surface
/// is, those leaves' source triangles. A part below a leaf is named by that leaf and its place among them.
class TreeParts {
 public:
  using Part = std::uint32_t;
  /// Leaves of more triangles are left whole, as no budget covers asking them.
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
  /// The node itself, or the leaf that a triangle is below.
  static NodeId nodeOf(Part part) { return isTriangle(part) ? (part & ~kTriangleBit) / kMaxTriangles : part; }
  /// Which of its leaf's triangles.
  static std::uint32_t indexOf(Part part) { return part % kMaxTriangles; }

  /// None for a triangle, and for a leaf that is no farther than `crude` (world length, certified) from its surface or
  /// names its faces.
  Children children(Part part, float crude) const;
  Triangle triangle(Part part) const;
  Sphere sphere(Part part) const;
  /// The part's point that lies farthest along `direction`.
  Vec3 support(Part part, const Vec3& direction) const;
  /// The normals of a part's faces, where it has any; else the middle of its normals, where it lies in a plane. Both
  /// ways: what is behind a flat region is apart from it along the opposite.
  void appendFaces(Part part, SeparatingNormals& normals) const;

 private:
  static constexpr Part kTriangleBit = 1U << 31;

  bool isCrude(NodeId leaf, float crude) const;

  PlacedTree tree_;
};

}  // namespace cairn::bullet
