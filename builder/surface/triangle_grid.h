// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A regular grid of cubic voxels over the bounding box of a mesh. Each voxel lists the triangles that meet it. It is
/// the "spatially enumerated auxiliary data structure" (SEADS) of thesis appendix A.
class TriangleGrid {
 public:
  using Voxel = std::array<std::uint32_t, 3>;

  /// `perSide`: number of voxels along the longest side of the box, 1 to 256. 0 chooses it so that about as many voxels
  /// have triangles as there are triangles. Precondition: at least one triangle. O(n + voxels) for triangles of similar
  /// size.
  explicit TriangleGrid(const TriangleMesh& mesh, std::uint32_t perSide = 0);

  const Bounds& bounds() const { return bounds_; }
  /// Number of voxels along each axis.
  const Voxel& size() const { return size_; }
  double voxelEdge() const { return edge_; }

  bool holds(const Vec3d& point) const;
  /// Returns the voxel of a point; for a point outside the box the nearest voxel. Indices never fall as a coordinate
  /// grows.
  Voxel voxelOf(const Vec3d& point) const;
  Vec3d centerOf(const Voxel& voxel) const;
  std::size_t indexOf(const Voxel& v) const { return (std::size_t{v[2]} * size_[1] + v[1]) * size_[0] + v[0]; }
  /// Returns in ascending order all triangles that meet the voxel. The list may include triangles within a billionth of
  /// the voxel's edge.
  std::span<const std::uint32_t> trianglesIn(const Voxel& voxel) const {
    const std::size_t i = indexOf(voxel);
    return std::span(list_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  template <class Visit>
  void forVoxelsOf(const std::array<Vec3d, 3>& corners, const Visit& visit) const;

  Bounds bounds_;
  double edge_ = 1;
  Voxel size_{1, 1, 1};
  std::vector<std::uint32_t> first_, list_;  // triangles of voxel i: list_[first_[i]] to list_[first_[i + 1]]
};

}  // namespace cairn::builder
