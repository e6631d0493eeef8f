// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Triangles in file order, each with its own three corners.
using TriangleSoup = std::vector<std::array<Vec3d, 3>>;

/// Polygons over shared points, as in the file. Each has three or more corners and any shape; a corner may occur twice.
/// In the file's frame and unit.
struct PolygonSoup {
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> corners;  ///< indices into `points`, polygon after polygon
  std::vector<std::size_t> ends;       ///< for each polygon: the position after its last corner in `corners`

  /// Ends a polygon: its corners are those added since the last one.
  void endPolygon() { ends.push_back(corners.size()); }
};

}  // namespace cairn::builder
