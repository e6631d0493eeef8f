// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/nearest_triangle.h"

namespace cairn::builder {

/// The point of a surface nearest to some query.
struct SurfacePoint {
  Vec3d point;
  double distance = 0;  ///< unsigned
  std::uint32_t triangle = 0;
};

/// Distance queries against a closed mesh: the hot path of the whole builder.
///
/// A bounding-volume hierarchy over the triangles in double precision; the sign comes from the angle-weighted
/// pseudonormal of the nearest feature (Baerentzen and Aanaes 2005), exact for closed meshes that do not intersect
/// themselves, and where rounding leaves that in doubt from the winding number. Below 1 us a query at 1500 triangles,
/// growing logarithmically. Safe to query from many threads. Queries must be finite.
class SignedDistance {
 public:
  /// Keeps a reference to `mesh`, which must outlive this. Precondition: `checkMesh(mesh)`.
  explicit SignedDistance(const TriangleMesh& mesh);
  explicit SignedDistance(TriangleMesh&&) = delete;  ///< it would not outlive this
  ~SignedDistance();
  SignedDistance(SignedDistance&&) noexcept;
  SignedDistance& operator=(SignedDistance&&) noexcept;

  SurfacePoint closest(const Vec3d& query) const;
  /// Positive inside, negative outside: "signed depth", s(c) of the design.
  double depth(const Vec3d& query) const;
  /// `closest` and `depth` in one query.
  struct Answer {
    SurfacePoint nearest;
    double depth = 0;
  };
  Answer query(const Vec3d& query) const;
  /// The same bits in less time, when the distance is known to be no more than `atMost` but for rounding.
  Answer query(const Vec3d& query, double atMost) const;
  /// Replaces `parts` by those of the surface that can be nearest to a point within `reach` of `center`, rounding
  /// included; see `queryAmong`. Returns the distance from `center` up to which they were taken; nothing when they are
  /// more than `most`. About the cost of a query. Precondition: `reach` >= 0, `distance` is that of `closest(center)`.
  std::optional<double> gather(const Vec3d& center, double distance, double reach, std::size_t most,
                               std::vector<NearPacket>& parts) const;
  /// `query` of a point within the reach that `parts` were gathered for, to the bit, but without a search: linear in
  /// the parts. For a smaller reach those farther than the returned distance less twice the difference may be left out.
  /// `moved` is how far the point is from the centre they were gathered around, or more.
  Answer queryAmong(std::span<const NearPacket> parts, const Vec3d& point, double moved) const;
  /// `depth` of many points, in parallel; the result does not depend on the number of threads.
  void depths(std::span<const Vec3d> queries, std::span<double> out) const;

  /// Unsigned distance from `point` to one triangle of the mesh: never less than `closest(point).distance`, and, as a
  /// triangle is convex, a convex function of `point`. Constant time.
  double distanceToTriangle(std::uint32_t triangle, const Vec3d& point) const;

  /// No distance or depth returned for `query` is farther than this from the exact one. See the derivation in
  /// `distanceRoundingBound`.
  double roundingBound(const Vec3d& query) const;

  const TriangleMesh& mesh() const;
  const Bounds& bounds() const;

 private:
  struct Hierarchy;
  Answer answerAt(TriangleHierarchy::Place place, const Vec3d& query) const;
  /// Of a point as far from the surface as told, where that is not sure of one triangle alone.
  bool isOutsideByAll(const Vec3d& query, double distance) const;
  std::unique_ptr<Hierarchy> hierarchy_;
};

}  // namespace cairn::builder
