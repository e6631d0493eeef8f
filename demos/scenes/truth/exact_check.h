// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// How one surface stands in the frame of another: `to = rotation * from + translation`. Precondition: rotation
/// orthonormal.
struct Placement {
  Mat3d rotation;
  Vec3d translation;

  Vec3d operator*(const Vec3d& p) const { return rotation * p + translation; }
  Placement inverse() const;
  friend Placement operator*(const Placement& outer, const Placement& inner);
};

/// A closed surface, prepared for exact questions about two of them: the referee of every scene. It works on triangles
/// with CGAL's exact predicates and shares no code with the collision shapes it judges.
class ExactSurface {
 public:
  /// Fails unless the triangles form a closed 2-manifold. Outward orientation is not needed.
  static Result<ExactSurface> create(std::span<const Vec3d> vertices,
                                     std::span<const std::array<std::uint32_t, 3>> triangles);
  ~ExactSurface();
  ExactSurface(ExactSurface&&) noexcept;
  ExactSurface& operator=(ExactSurface&&) noexcept;

  /// Distance to the surface, negative outside. One nearest-point query and one ray.
  double depth(const Vec3d& point) const;

  /// Distance to the surface, from either side. One nearest-point query.
  double distanceTo(const Vec3d& point) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit ExactSurface(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// How deep surface `a` reaches into the solid `b`: the maximum, over the points of `a` inside `b`, of the distance to
/// the surface of `b`; 0 if there are none. Too small by at most `tolerance` (> 0, same unit). Vertices first, then
/// branch and bound over the triangles: over a piece of `a` the distance to `b` is at most that to any one triangle of
/// `b`, and the latter, being convex, is largest at a corner of the piece. What is not deeper than `known` is passed
/// over, and the answer is at least `known`: the worst of many pairs costs little more than that pair alone.
double penetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                   double known = 0);

/// The deeper of both ways: how far either surface reaches into the other solid.
double mutualPenetration(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA, double tolerance,
                         double known = 0);

/// Whether two surfaces have a point in common, by exact predicates on the placed triangles. One surface wholly inside
/// the other does not count; two placements of the same connected surface cannot be so.
bool surfacesMeet(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA);

/// Least distance between two surfaces, 0 where they cross. Exact up to rounding: vertices against triangles both ways,
/// then edges against edges of the triangles that could be nearer still.
double surfaceDistance(const ExactSurface& a, const ExactSurface& b, const Placement& bFromA);

}  // namespace cairn::scenes
