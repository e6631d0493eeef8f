// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <bitset>

#include "faces/placed_mesh.h"

namespace cairn::bullet {

/// A mesh of few triangles, looked at along a direction: what lies lowest, and which triangles face against it.
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
