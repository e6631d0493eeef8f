// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::bench {

/// The flat convex faces of a mesh: neighbouring triangles of one plane whose union is convex. The distance to such a
/// face is a convex function, as that to one triangle is, so bounds by convexity do not end at the seams between the
/// triangles of a face.
class FlatFaces {
 public:
  /// Precondition: `checkMesh(mesh)`. O(n log n).
  explicit FlatFaces(const builder::TriangleMesh& mesh);

  /// The triangles of the face that a triangle lies in; the triangle alone where the face is not convex.
  std::span<const std::uint32_t> around(std::uint32_t triangle) const {
    const Face face = faces_[triangle];
    return {triangles_.data() + face.first, face.count};
  }
  /// No point of a face's convex hull is farther than this from the face (mesh unit).
  double guard() const { return guard_; }

 private:
  struct Face {
    std::uint32_t first = 0, count = 0;
  };
  std::vector<std::uint32_t> triangles_;  // by face
  std::vector<Face> faces_;               // by triangle
  double guard_ = 0;
};

}  // namespace cairn::bench
