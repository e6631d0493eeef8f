// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A frame that moves, turns and grows with a mesh. Results in this frame do not depend on the mesh's position,
/// rotation or unit. The origin is the mean vertex; the unit is the distance of the farthest vertex. The first axis
/// points to that vertex. The second axis points towards the vertex farthest from the first axis.
///
/// Among vertices at about the same distance the first one counts. So rounding cannot flip the frame of a symmetric
/// mesh, but the frame depends on the order of vertices. Precondition: the vertices do not lie on one line. Linear.
class BodyFrame {
 public:
  explicit BodyFrame(const TriangleMesh& mesh);

  /// Converts a point from the mesh frame into this frame, and back.
  Vec3d into(const Vec3d& point) const;
  Vec3d outOf(const Vec3d& point) const;
  Ball outOf(const Ball& ball) const;
  /// The frame's unit of length, in mesh units.
  double unit() const { return unit_; }

 private:
  Vec3d origin_;
  double unit_ = 1;
  std::array<Vec3d, 3> axes_;
};

/// Largest displacement of a vertex by `bodyMesh`, in the frame's unit.
inline constexpr double kBodyRounding = 0x1p-22;

/// Returns the mesh in the frame, with its vertices rounded to a grid of that frame. Meshes that differ only by a
/// motion, a scale and rounding become equal bit for bit. All results computed from them are then equal too. Vertices
/// are not rounded when some triangle is too narrow for it; then such meshes still differ by rounding. Linear.
TriangleMesh bodyMesh(const TriangleMesh& mesh, const BodyFrame& frame);

}  // namespace cairn::builder
