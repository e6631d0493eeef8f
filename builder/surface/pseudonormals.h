// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// Angle-weighted normals of every feature of a closed mesh (Baerentzen and Aanaes 2005). Take a point whose nearest
/// surface point lies on a feature. The point is outside exactly when its offset has a positive product with that
/// feature's pseudonormal. The proof needs only that the mesh bounds a solid around the feature. So vertices where two
/// cones touch are allowed.
class Pseudonormals {
 public:
  /// Precondition: `checkMesh(mesh)`. O(n log n).
  explicit Pseudonormals(const TriangleMesh& mesh);

  /// Returns the pseudonormal of a feature; its length is arbitrary. Precondition: `triangle` belongs to `mesh`, the
  /// mesh of the constructor.
  const Vec3d& at(const TriangleMesh& mesh, std::uint32_t triangle, Feature feature) const;

  /// True when a corner of the triangle lies on an edge sharper than a degree, convex or concave. There the other side
  /// of the solid is equally near up to rounding, and pseudonormals may consist mostly of rounding errors.
  bool besideSharpEdge(std::uint32_t triangle) const { return sharp_[triangle] != 0; }

 private:
  void findSharpEdges(const TriangleMesh& mesh);

  std::vector<Vec3d> faces_, vertices_;
  std::vector<std::uint8_t> sharp_;          // by triangle
  std::vector<std::array<Vec3d, 3>> edges_;  // by triangle and edge number
};

}  // namespace cairn::builder
