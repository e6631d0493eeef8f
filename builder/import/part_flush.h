// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// Moves faces of bodies outward that nearly coincide with a face of another body, so that the two overlap or stand
/// apart by more than floats can blur. Faces that coincide exactly stay. In each pair the smaller body's face moves, by
/// 1.5 tolerances, or a multiple where several bodies are flush. Returns the number of moved triangles.
/// Precondition: the mesh is settled and balanced, and its bodies face away from their solids. The result is settled.
std::size_t partFlushFaces(TriangleMesh& mesh, double tolerance);

}  // namespace cairn::builder
