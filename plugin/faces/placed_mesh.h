// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "contacts/directional_gap.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// The source mesh of a tree with few triangles, seen from the pair frame. Made anew in every step, on the stack.
class PlacedMesh {
 public:
  static constexpr std::size_t kMaxTriangles = 64;
  static constexpr std::size_t kMaxVertices = 3 * kMaxTriangles;
  /// Fraction of a mesh's reach by which rounding may lift a vertex over the plane of a face it belongs to.
  static constexpr float kPlaneSlack = 1e-5F;

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

}  // namespace cairn::bullet
