// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Three indices of vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh in its own frame and unit; triangles are counter-clockwise seen from outside. Meshes of
/// `importMesh` are closed, oriented outward, welded and free of degenerate triangles. `checkMesh` checks a mesh from
/// any other source.
///
///     TriangleMesh mesh{.vertices = points, .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
///     Status solid = checkMesh(mesh);
struct TriangleMesh {
  std::vector<Vec3d> vertices;      ///< mesh frame and unit
  std::vector<Triangle> triangles;  ///< indices into `vertices`
  std::string name;                 ///< file name without folder, for reports
  std::string sha256;               ///< of the file's bytes, hexadecimal; empty for a mesh without a file

  /// Returns the corners of a triangle by its index.
  std::array<Vec3d, 3> corners(std::uint32_t triangle) const {
    const Triangle& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};

/// The axis-aligned bounding box of a mesh. Mesh frame and unit.
struct Bounds {
  Vec3d lower, upper;  ///< least and greatest coordinates
  /// Length of the diagonal: the size that fractions refer to.
  double diagonal() const { return length(upper - lower); }
  /// The middle of the box.
  Vec3d center() const { return (lower + upper) * 0.5; }
};
/// Returns the bounding box of a mesh. Precondition: at least one vertex. Linear.
Bounds boundsOf(const TriangleMesh& mesh);

}  // namespace cairn::builder
