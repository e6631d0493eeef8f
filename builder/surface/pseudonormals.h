// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// Angle-weighted normals of every feature of a closed mesh (Baerentzen and Aanaes 2005): a point whose nearest surface
/// point lies on a feature is outside exactly when its offset has a positive product with that feature's pseudonormal.
/// The proof needs only that the mesh bounds a solid around the feature, so vertices where two cones touch are fine.
class Pseudonormals {
 public:
  /// Precondition: `checkMesh(mesh)`. O(n log n).
  explicit Pseudonormals(const TriangleMesh& mesh);

  /// Not unit; only its direction means something. Precondition: `triangle` is one of `mesh`, the mesh of the
  /// constructor.
  const Vec3d& at(const TriangleMesh& mesh, std::uint32_t triangle, Feature feature) const;

  /// Whether a corner of the triangle is on an edge sharper than a degree, from within or from without. There the other
  /// side of the solid is as near but for rounding, and pseudonormals may be little else than rounding.
  bool besideSharpEdge(std::uint32_t triangle) const { return sharp_[triangle] != 0; }

 private:
  void findSharpEdges(const TriangleMesh& mesh);

  std::vector<Vec3d> faces_, vertices_;
  std::vector<std::uint8_t> sharp_;          // by triangle
  std::vector<std::array<Vec3d, 3>> edges_;  // by triangle and edge number
};

}  // namespace cairn::builder
