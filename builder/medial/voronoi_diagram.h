// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::builder {

/// A point equally far from four sites; no other site is nearer.
struct VoronoiVertex {
  Vec3d position;  ///< rounded; not finite for four sites that are very nearly coplanar
  std::array<std::uint32_t, 4> sites{};
  bool alive = true;  ///< false once a later site came nearer
};

/// An incremental Voronoi diagram of points in space. It is the dual of a Delaunay triangulation with exact predicates.
/// Coincident, coplanar and cospherical sites are therefore safe (this replaces thesis 4.1.2-4.1.4). Equal input gives
/// equal output. Only its .cpp includes CGAL's triangulations.
///
///     VoronoiDiagram diagram(boundsOf(mesh));
///     for (const Vec3d& site : sites) diagram.insert(site);
///     for (const VoronoiVertex& vertex : diagram.vertices()) use(vertex); // check vertex.alive
class VoronoiDiagram {
 public:
  /// Sites 0 to 7 enclose `bounds` from far away, so that every later cell is bounded (thesis 4.1.3).
  static constexpr std::uint32_t kEnclosingSites = 8;

  /// Precondition: `bounds` has a positive diagonal.
  explicit VoronoiDiagram(const Bounds& bounds);
  ~VoronoiDiagram();
  VoronoiDiagram(VoronoiDiagram&&) noexcept;
  VoronoiDiagram& operator=(VoronoiDiagram&&) noexcept;

  /// Adds a site inside the bounds; false when it exists already. `near` names a living vertex close by, where the
  /// search starts. Expected constant time with a good `near`.
  bool insert(const Vec3d& site, std::uint32_t near);
  bool insert(const Vec3d& site);

  /// All vertices that ever existed, dead ones included. A vertex keeps its index.
  std::span<const VoronoiVertex> vertices() const;
  /// Index of the first vertex that the last `insert` created. New vertices are the last ones of `vertices()`.
  std::uint32_t firstOfLastInsert() const;
  /// The vertices that the last `insert` removed.
  std::span<const std::uint32_t> endedByLastInsert() const;
  const Vec3d& site(std::uint32_t index) const;
  std::uint32_t siteCount() const;

 private:
  struct Triangulation;
  std::unique_ptr<Triangulation> triangulation_;
};

}  // namespace cairn::builder
