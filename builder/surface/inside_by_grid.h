// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "surface/triangle_grid.h"

namespace cairn::builder {

/// A grid whose voxels are known to lie inside, outside, or astride the surface (thesis A.3): most points are answered
/// by a look at their voxel, the others by another test. For many queries that want the side and not the distance.
class InsideByGrid {
 public:
  using Test = std::function<bool(const Vec3d&)>;

  /// `test` answers for points of the box and must outlive this; it is asked once for each voxel without triangles.
  /// `perSide` as for `TriangleGrid`. Precondition: `checkMesh(mesh)`, which is not kept.
  InsideByGrid(const TriangleMesh& mesh, Test test, std::uint32_t perSide = 0);

  /// As right as `test`. Safe from many threads when `test` is.
  bool inside(const Vec3d& point) const;

  /// Share of the box's volume where a look is enough.
  double decidedFraction() const;

 private:
  enum class Side : std::uint8_t { outside, inside, undetermined };

  TriangleGrid grid_;
  Test test_;
  std::vector<Side> sides_;  // by voxel
};

}  // namespace cairn::builder
