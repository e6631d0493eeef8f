// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A point equally far from four sites and no nearer to any other.
struct VoronoiVertex {
  Vec3d position;  ///< rounded; not finite for four sites that are very nearly coplanar
  std::array<std::uint32_t, 4> sites{};
  bool alive = true;  ///< false once a later site came nearer
};

/// Incremental Voronoi diagram of points in space: the dual of a Delaunay triangulation with exact predicates, so that
/// coincident, coplanar and cospherical sites are all well (this replaces thesis 4.1.2-4.1.4). Equal input gives equal
/// output. The only file that sees CGAL's triangulations is its .cpp.
class VoronoiDiagram {
 public:
  /// Sites 0 to 7 enclose `bounds` from far away, so that every later cell is bounded (thesis 4.1.3).
  static constexpr std::uint32_t kEnclosingSites = 8;

  /// Precondition: `bounds` has a positive diagonal.
  explicit VoronoiDiagram(const Bounds& bounds);
  ~VoronoiDiagram();
  VoronoiDiagram(VoronoiDiagram&&) noexcept;
  VoronoiDiagram& operator=(VoronoiDiagram&&) noexcept;

  /// Adds a site inside the bounds; false when it is one already. `near` names a living vertex close by, to start the
  /// search from. Expected constant time with a good `near`.
  bool insert(const Vec3d& site, std::uint32_t near);
  bool insert(const Vec3d& site);

  /// All vertices that ever were, dead ones included; a vertex keeps its index.
  std::span<const VoronoiVertex> vertices() const;
  /// Index of the first vertex the last `insert` created; they are the last of `vertices()`.
  std::uint32_t firstOfLastInsert() const;
  /// The vertices the last `insert` ended.
  std::span<const std::uint32_t> endedByLastInsert() const;
  const Vec3d& site(std::uint32_t index) const;
  std::uint32_t siteCount() const;

 private:
  struct Triangulation;
  std::unique_ptr<Triangulation> triangulation_;
};

}  // namespace cairn::builder
