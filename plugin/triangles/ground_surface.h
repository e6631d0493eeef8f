// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/core/tree_surface.h"
#include "triangles/triangle_soup.h"

namespace cairn::bullet {

/// The surface that the triangles of one of Bullet's meshes make: corners in one place are one vertex. Immutable.
class GroundSurface {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// That of the shape, shared by all who ask while anyone has it; null for what is no mesh. It is made when it is
  /// first asked for, from all triangles, some microseconds each: whoever uses it is to see by `triangleOf` whether it
  /// still is the shape's.
  static std::shared_ptr<const GroundSurface> of(const btConcaveShape& shape);

  /// Whether it is the surface of one solid: in one piece, each side of a triangle shared with one other that shows the
  /// same side, outwards by the right-hand rule. Nothing else is known of what is not, or of meshes of more than
  /// `tuning::kMaxTriangles`.
  bool isSolid() const { return isSolid_; }
  /// Frame: the shape's axes, from `origin`; unit: world length. Precondition of this and all that follows: `isSolid`.
  SurfaceView view() const { return {vertices_, triangles_, &derived_}; }
  /// In the shape's frame.
  const btVector3& origin() const { return origin_; }
  /// Which triangle of the surface it is; `kNone` if the shape had another one, or none, of these numbers.
  std::uint32_t triangleOf(const TriangleSoup::Source& source) const;
  /// What the shape calls it.
  const TriangleSoup::Source& source(std::uint32_t triangle) const { return soup_.triangles()[triangle]; }

 private:
  explicit GroundSurface(const btConcaveShape& shape);

  bool weld();
  bool isClosed() const;
  bool isInOnePiece() const;
  double volume() const;

  bool isSolid_ = false;
  TriangleSoup soup_;
  btVector3 origin_{0, 0, 0};
  std::vector<Vec3> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  TreeSurface derived_;
};

}  // namespace cairn::bullet
