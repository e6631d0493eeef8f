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

/// The surface that the triangles of one of Bullet's meshes form: corners in one place are one vertex. Immutable.
///
///     const auto surface = GroundSurface::of(shape);
///     if (surface && surface->isSolid()) use(surface->view());
class GroundSurface {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// The surface of the shape, shared by all callers while any of them keeps the pointer; null for shapes that are not
  /// meshes. The first call makes it from all triangles, some microseconds each. The caller must check with
  /// `triangleOf` that it still matches the shape.
  static std::shared_ptr<const GroundSurface> of(const btConcaveShape& shape);

  /// Whether it is the surface of one solid: in one piece, closed, with all fronts outwards by the right-hand rule.
  /// Closed means that each side of a triangle is shared with exactly one other, which runs along it the other way.
  /// False for meshes of more than `tuning::kMaxTriangles`. Without a solid no other data exists.
  bool isSolid() const { return isSolid_; }
  /// Frame: the shape's axes, from `origin`; unit: world length. Precondition of this and all below: `isSolid`.
  SurfaceView view() const { return {vertices_, triangles_, &derived_}; }
  /// In the shape's frame.
  const btVector3& origin() const { return origin_; }
  /// The index of this triangle on the surface; `kNone` if the shape had another triangle, or none, with these numbers.
  std::uint32_t triangleOf(const TriangleSoup::Source& source) const;
  /// The shape's own numbers for a triangle.
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
