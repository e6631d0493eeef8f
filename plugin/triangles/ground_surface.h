// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "cairn/core/tree_surface.h"
#include "triangles/triangle_soup.h"

namespace cairn::bullet {

/// The surface that the triangles of one of Bullet's meshes make: corners in one place are one vertex. Immutable.
class GroundSurface {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  /// Larger meshes have none: what is derived takes about half a kilobyte a triangle, and some microseconds.
  static constexpr std::size_t kMostTriangles = 200000;

  /// That of the shape, shared by all who ask while anyone has it; null for what has none. It is made when it is first
  /// asked for: whoever does is to see by `triangleOf` whether it still is the shape's.
  static std::shared_ptr<const GroundSurface> of(const btConcaveShape& shape);

  /// Of the side that faces show by the right-hand rule, or of the other one. Frame: the shape's axes, from `origin`.
  SurfaceView view(bool isReversed) const;
  /// In the shape's frame.
  const btVector3& origin() const { return origin_; }
  /// Which triangle of the surface it is; `kNone` if the shape had another one, or none, of these numbers.
  std::uint32_t triangleOf(const TriangleSoup::Source& source) const;
  /// What the shape calls it.
  const TriangleSoup::Source& source(std::uint32_t triangle) const { return soup_.triangles()[triangle]; }
  /// Of the pieces that triangles are joined to, all showing the same side, the one it belongs to.
  std::uint32_t pieceOf(std::uint32_t triangle) const { return pieces_[triangle]; }
  /// Whether that is closed: each side joins a triangle with one other.
  bool isClosed(std::uint32_t piece) const { return !isOpen_[piece]; }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  explicit GroundSurface(const btConcaveShape& shape);

  bool weld();
  std::vector<bool> looseEdges() const;
  void findPieces();
  static TreeSurface derivedFrom(std::span<const Vec3> vertices, std::span<const Corners> triangles);

  TriangleSoup soup_;
  btVector3 origin_{0, 0, 0};
  std::vector<Vec3> vertices_;
  std::vector<Corners> triangles_, reversed_;
  TreeSurface derived_;
  mutable std::once_flag isAskedForReversed_;
  mutable TreeSurface derivedOfReversed_;  // made when it is first asked for: few are
  std::vector<std::uint32_t> pieces_;      // of each triangle, the first of its piece
  std::vector<bool> isOpen_;               // by piece
};

}  // namespace cairn::bullet
