// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// The pose of one surface in the frame of another: `to = rotation * from + translation`. Precondition: `rotation` is
/// orthonormal.
struct Placement {
  Mat3d rotation;
  Vec3d translation;

  Vec3d operator*(const Vec3d& p) const { return rotation * p + translation; }
  Placement inverse() const;
  friend Placement operator*(const Placement& outer, const Placement& inner);
};

/// A closed surface, prepared for exact questions about two surfaces. It judges every scene. It works on triangles with
/// CGAL's exact predicates and shares no code with the collision shapes it judges.
///
///     const ExactSurface surface = ExactSurface::create(model.vertices, model.triangles).value();
///     const double depth = mutualPenetration(surface, surface, bFromA, 1e-4);
class ExactSurface {
 public:
  /// Fails unless the triangles form a closed 2-manifold. Outward orientation is not needed.
  static Result<ExactSurface> create(std::span<const Vec3d> vertices,
                                     std::span<const std::array<std::uint32_t, 3>> triangles);
  ~ExactSurface();
  ExactSurface(ExactSurface&&) noexcept;
  ExactSurface& operator=(ExactSurface&&) noexcept;

  /// Returns the distance to the surface, negative outside. Cost: one nearest-point query and one ray.
  double depth(const Vec3d& point) const;

  /// Returns the distance to the surface from either side. Cost: one nearest-point query.
  double distanceTo(const Vec3d& point) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit ExactSurface(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Returns the penetration of surface `a` into the solid `b`. It is the maximum distance to the surface of `b` over the
/// points of `a` inside `b`; 0 without such points. The result is too small by at most `tolerance` (> 0, same unit).
///
/// Vertices are tested first, then branch and bound runs over the triangles. Over a piece of `a`, the distance to `b`
/// is at most that to any one triangle of `b`. That distance is convex, so it is largest at a corner of the piece.
/// Pieces not deeper than `known` are skipped, and the result is at least `known`. So the worst of many pairs costs
/// little more than that pair alone.
double penetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                   double known = 0);

/// Returns the larger of both penetrations: `a` into `b`, and `b` into `a`.
double mutualPenetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                         double known = 0);

/// True when two surfaces have a common point, by exact predicates on the placed triangles. A surface entirely inside
/// the other does not count; this cannot occur for two placements of one connected surface.
bool surfacesMeet(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA);

/// Returns the least distance between two surfaces, 0 where they intersect. Exact up to rounding. Vertices are measured
/// against triangles in both directions, then edges against edges of triangles that could be nearer.
double surfaceDistance(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA);

}  // namespace cairn::scenes
