// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Parts of a mesh's triangles, in double precision.
struct PartsOfMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> source;  ///< for each triangle: the one it is a part of
};

/// The bodies of a mesh: closed surfaces, each with a winding number of its own.
struct BodiesOfMesh {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<std::uint32_t> hollowOf;  ///< for each body: the one that it is a hollow of, or itself
};

/// The surface of what the bodies of a mesh enclose, outside their hollows.
struct UnitedSurface {
  PartsOfMesh forward;           ///< of all points around which a body winds forward; faces away from them
  PartsOfMesh backward;          ///< likewise, of all points around which a body winds backwards
  std::size_t cutTriangles = 0;  ///< triangles that were divided where surfaces meet
};

/// Returns the surface of all points around which a body of a closed mesh winds, and none of that body's hollows does.
/// Bodies that overlap or touch become one, as do hollows, and what lies inside vanishes. Where a body folds through
/// itself it winds backwards. All decisions are exact; only the vertices of the result are rounded. Where solids touch
/// along an edge, that edge has four triangles. Fails, without the mesh's name, when CGAL does.
///
/// Preconditions: each body's triangles cancel at every edge, vertices at equal positions are one, no triangle lacks
/// area. Cost: as `arrange`, plus a ray through all triangles for each part of the surface between lines in which it
/// meets itself.
Result<UnitedSurface> unitedSurface(const TriangleMesh& mesh, const BodiesOfMesh& bodies);

}  // namespace cairn::builder
