// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_grid.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// Hubbard's closest-point test (thesis A.1): a point is inside when it lies behind the nearest part of the surface. A
/// reference to compare with, not what the builder uses: at a corner it wants the point behind every face that meets
/// there, which is too much where the surface is a saddle, so points inside may be called outside, never the reverse.
/// `SignedDistance` mends that by pseudonormals.
class InsideByClosestPoint {
 public:
  /// Keeps a reference to `mesh`, which must outlive this; `perSide` as for `TriangleGrid`. Precondition:
  /// `checkMesh(mesh)`. O(n log n).
  explicit InsideByClosestPoint(const TriangleMesh& mesh, std::uint32_t perSide = 0);

  /// On the surface, within rounding, the answer means nothing. Safe from many threads.
  bool inside(const Vec3d& point) const;

  /// The nearest triangle, the part of it that is nearest, and the vector from there to the point. Voxels in rings
  /// around the point's own, until a ring is farther away than the best (thesis A.1, figure A.2). For any point.
  struct Nearest {
    std::uint32_t triangle = 0;
    TrianglePacket::Nearest place;
  };
  Nearest nearest(const Vec3d& point) const;

 private:
  bool isBehind(std::uint32_t triangle, const Vec3d& offset) const { return dot(offset, normals_[triangle]) < 0; }
  bool isBehindEdge(std::uint32_t triangle, int edge, const Vec3d& offset) const;
  bool isBehindCorner(std::uint32_t vertex, const Vec3d& offset) const;

  const TriangleMesh& mesh_;
  TriangleGrid grid_;
  std::vector<TrianglePacket> packets_;                       // triangle t in lane t % kWidth of packet t / kWidth
  std::vector<Vec3d> normals_;                                // unit, by triangle
  std::vector<std::array<std::uint32_t, 3>> neighbours_;      // by triangle and edge
  std::vector<std::uint32_t> firstAround_, trianglesAround_;  // by vertex: those that share it
};

}  // namespace cairn::builder
