// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::python {

/// Reads NumPy arrays into a mesh: vertices (n, 3) of float64 or float32, triangles (m, 3) of whole numbers of 32 or 64
/// bits. Any strides will do. The numbers go straight into the mesh's own vectors, once: 24 bytes a vertex and 12 bytes
/// a triangle, without an array in between. The mesh must not share the caller's memory, because a later write to it
/// would change a solid that is already proved, and break indices that are already checked.
///
/// Raises cairn.Error for other shapes and types, for coordinates that are not finite and for indices out of range.
/// Does not check that the triangles bound a solid. The interpreter's lock is held.
builder::TriangleMesh meshOfArrays(const pybind11::object& vertices, const pybind11::object& triangles,
                                   const std::string& name);

/// Reads spheres, shape (n, 4), float64 or float32: centre and radius. The same rules; radii are above 0.
std::vector<builder::Ball> ballsOfArray(const pybind11::object& spheres);

}  // namespace cairn::python
