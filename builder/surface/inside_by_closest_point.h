// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_grid.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// Hubbard's closest-point test (thesis A.1): a point is inside when it lies behind the nearest part of the surface. It
/// is a reference for comparison; the builder does not use it. At a corner it requires the point to be behind every
/// face there, which is too strict at a saddle. So it may call an inside point outside, but never the reverse.
/// `SignedDistance` avoids this error by pseudonormals.
class InsideByClosestPoint {
 public:
  /// Keeps a reference to `mesh`, which must outlive this object. For `perSide` see `TriangleGrid`. Precondition:
  /// `checkMesh(mesh)`. O(n log n).
  explicit InsideByClosestPoint(const TriangleMesh& mesh, std::uint32_t perSide = 0);

  /// True for a point inside. For points on the surface, within rounding, the answer is arbitrary. Thread-safe.
  bool inside(const Vec3d& point) const;

  /// The nearest triangle, its nearest feature, and the vector from the nearest point to the query. The search visits
  /// voxels in rings around the query's own, until a ring is farther away than the best (thesis A.1, figure A.2). Valid
  /// for any point.
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
  std::vector<std::uint32_t> firstAround_, trianglesAround_;  // by vertex: the triangles that share it
};

}  // namespace cairn::builder
