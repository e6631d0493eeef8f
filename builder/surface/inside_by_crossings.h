// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_grid.h"

namespace cairn::builder {

/// The crossings test (thesis A.2): a point is inside when a ray from it meets the surface an odd number of times. Rays
/// close to an edge may count wrongly. So two rays are sent, and further pairs vote while the rays are split evenly. It
/// is a reference for comparison; the builder does not use it. It needs no orientation, only a closed surface.
class InsideByCrossings {
 public:
  /// Keeps a reference to `mesh`, which must outlive this object. For `perSide` see `TriangleGrid`. O(n).
  explicit InsideByCrossings(const TriangleMesh& mesh, std::uint32_t perSide = 0) : mesh_(mesh), grid_(mesh, perSide) {}

  /// True for a point inside. For points on the surface, within rounding, the answer is arbitrary. Thread-safe; the
  /// same point gives the same answer.
  bool inside(const Vec3d& point) const;

  /// Returns the number of triangles that the ray meets, along the voxels it passes (a DDA: Amanatides and Woo 1987).
  /// Preconditions: the point lies in the mesh's box, `direction` is not zero.
  std::uint32_t crossings(const Vec3d& point, const Vec3d& direction) const;

  /// Returns the direction of the first ray of `inside`.
  static Vec3d firstDirection();

 private:
  const TriangleMesh& mesh_;
  TriangleGrid grid_;
};

}  // namespace cairn::builder
