// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <span>

#include "contacts/directional_gap.h"
#include "counterparts/placed_tree.h"

namespace cairn::bullet {

/// The source mesh of a tree with few triangles, seen from the pair frame. Made anew in every step, on the stack.
class PlacedMesh {
 public:
  static constexpr std::size_t kMaxTriangles = 64;
  static constexpr std::size_t kMaxVertices = 3 * kMaxTriangles;

  /// Whether a tree's mesh is small enough.
  static bool serves(const SphereTree& tree) {
    return tree.triangles().size() <= kMaxTriangles && tree.vertices().size() <= kMaxVertices;
  }
  /// Whether no vertex lies in front of any triangle's plane, up to rounding. Triangles times vertices.
  static bool isConvex(const SphereTree& tree);
  /// Unit outward normal of a triangle in the tree's axes; zero for one without area.
  static Vec3 outwards(const SphereTree& tree, std::size_t triangle);

  /// Precondition: `serves`; `outwards` are those of the tree's triangles, in its axes.
  PlacedMesh(const PlacedTree& placed, std::span<const Vec3> outwards);

  const SphereTree& tree() const { return tree_; }
  /// World length: of the ball around it.
  float radius() const { return radius_; }
  std::span<const Vec3> vertices() const { return std::span(vertices_).first(tree_.vertices().size()); }
  std::span<const Vec3> outwards() const { return std::span(outwards_).first(tree_.triangles().size()); }
  DirectionalGap::Corners corners(std::size_t triangle, const WindowView& view) const;
  /// The least height of its vertices along a direction.
  float lowest(const Vec3& direction) const;
  /// That of a triangle's.
  float lowest(std::size_t triangle, const Vec3& direction) const;

 private:
  const SphereTree& tree_;
  float radius_;
  std::array<Vec3, kMaxVertices> vertices_;
  std::array<Vec3, kMaxTriangles> outwards_;
};

/// Such a mesh, looked at along a direction: what lies lowest, and which triangles face against it.
class MeshView {
 public:
  /// `direction`: unit, pair frame.
  void look(const PlacedMesh& mesh, const Vec3& direction);

  float lowest() const { return lowest_; }
  float lowest(std::size_t triangle) const { return lowestOf_[triangle]; }
  bool faces(std::size_t triangle) const { return isFacing_[triangle]; }
  /// Within 10 degrees.
  bool isFlush(std::size_t triangle) const { return isFlush_[triangle]; }
  /// Whether all corners of a triangle that are not above `limit` are corners of flush ones too.
  bool isSaidByFlush(const PlacedMesh& mesh, std::size_t triangle, float limit) const;
  /// Whether the direction is, reversed, among the outward normals of a convex mesh at one of its points, or misses
  /// them by at most 10 degrees: seen from the point, nothing of the mesh lies lower than that. `height`: the point's.
  bool isExtreme(const PlacedMesh& mesh, const Vec3& point, float height) const;

 private:
  float lowest_ = 0;
  std::array<float, PlacedMesh::kMaxVertices> height_;
  std::array<float, PlacedMesh::kMaxTriangles> lowestOf_;
  std::bitset<PlacedMesh::kMaxTriangles> isFacing_, isFlush_;
  std::bitset<PlacedMesh::kMaxVertices> isOnFlush_;
};

}  // namespace cairn::bullet
