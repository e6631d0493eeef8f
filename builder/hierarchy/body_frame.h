// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A frame that moves, turns and grows with a mesh: what is computed in it does not depend on where the mesh lies, how
/// it is turned or in what unit it is measured. Its origin is the mean vertex, its unit the distance of the farthest
/// one, its first axis points to that vertex and its second towards the one farthest from this axis; the first vertex
/// counts of those about as far, so that symmetric meshes have a frame that rounding cannot flip, but that depends on
/// the order of their vertices. Precondition: the vertices do not lie on one line. Linear.
class BodyFrame {
 public:
  explicit BodyFrame(const TriangleMesh& mesh);

  /// Of a point in the mesh frame, and back.
  Vec3d into(const Vec3d& point) const;
  Vec3d outOf(const Vec3d& point) const;
  Ball outOf(const Ball& ball) const;
  /// The frame's unit of length in the mesh's.
  double unit() const { return unit_; }

 private:
  Vec3d origin_;
  double unit_ = 1;
  std::array<Vec3d, 3> axes_;
};

/// Most by which `bodyMesh` displaces a vertex, in the frame's unit.
inline constexpr double kBodyRounding = 0x1p-22;

/// The mesh in the frame, its vertices rounded to a grid of that frame: meshes that differ only by a motion, a scale
/// and rounding become the same bit for bit, and so does all that is computed from them. Vertices are not rounded when
/// some triangle is too narrow for that; then the same meshes differ by rounding still. Linear.
TriangleMesh bodyMesh(const TriangleMesh& mesh, const BodyFrame& frame);

}  // namespace cairn::builder
