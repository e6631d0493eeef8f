// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Triangles of a file, each with its own three corners, in file order.
using TriangleSoup = std::vector<std::array<Vec3d, 3>>;

/// Polygons over shared points as a file lists them: three or more corners each, of any shape, maybe the same corner
/// twice. In the file's frame and unit.
struct PolygonSoup {
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> corners;  ///< places in `points`, of all polygons in turn
  std::vector<std::size_t> ends;       ///< of each polygon: behind its last corner in `corners`

  /// The corners added since the last polygon become one.
  void endPolygon() { ends.push_back(corners.size()); }
};

}  // namespace cairn::builder
