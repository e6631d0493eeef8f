// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "surface/triangle_grid.h"

namespace cairn::builder {

/// A grid whose voxels are marked as inside, outside or on the surface (thesis A.3). A look at its voxel answers for
/// most points; another test answers for the others. For many queries that need the side and not the distance.
class InsideByGrid {
 public:
  using Test = std::function<bool(const Vec3d&)>;

  /// `test` answers for points of the box and must outlive this object. It is called once for each voxel without
  /// triangles. For `perSide` see `TriangleGrid`. Precondition: `checkMesh(mesh)`. `mesh` is not kept.
  InsideByGrid(const TriangleMesh& mesh, Test test, std::uint32_t perSide = 0);

  /// True for a point inside; as reliable as `test`. Thread-safe when `test` is.
  bool inside(const Vec3d& point) const;

  /// Returns the share of the box's volume in which the voxel alone decides.
  double decidedFraction() const;

 private:
  enum class Side : std::uint8_t { outside, inside, undetermined };

  TriangleGrid grid_;
  Test test_;
  std::vector<Side> sides_;  // by voxel
};

}  // namespace cairn::builder
