// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "balls/piece.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::bench {

/// A part of a mesh's surface: triangles that lie in triangles of the mesh, up to the rounding of cuts. Mesh frame.
using SurfacePart = builder::Pieces;

/// A plane across an axis of the mesh's frame.
struct AxisPlane {
  int axis = 0;
  double at = 0;
};

/// Cuts a part along a plane: what lies below it, and what lies above. A triangle in the plane goes to the side that
/// its solid is on.
std::array<SurfacePart, 2> cut(const SurfacePart& part, const AxisPlane& plane);

/// The coordinates at which a mesh has vertices, axis by axis, in order; none for an axis with more than `most`.
std::array<std::vector<double>, 3> vertexCoordinates(const builder::TriangleMesh& mesh, std::size_t most);

/// Planes a part may be cut along: the middles of its box, and within it those through vertices (`coordinates`), where
/// a solid made of blocks comes apart. None for a point.
std::vector<AxisPlane> planesThrough(const SurfacePart& part, const std::array<std::vector<double>, 3>& coordinates);

}  // namespace cairn::bench
