// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <memory>
#include <optional>
#include <span>

#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"
#include "colliders/closed_forms.h"
#include "colliders/hull_faces.h"
#include "kernel/convex_body.h"

namespace cairn::bullet {

/// Distance queries against one convex shape, in the shape's frame, margin included. Boxes and round shapes are
/// answered in closed form, hulls by their faces. All others use GJK, and EPA inside.
///
///     ConvexSurface surface;
///     surface.setShape(shape);
///     const NearestPoint nearest = surface.nearest(p);
class ConvexSurface {
 public:
  /// The points a leaf has: its support points and its region's corners.
  static constexpr std::size_t kMaxHullPoints = kMaxSupportPoints + kMaxRegionCorners;

  ConvexSurface() : point_(0) { points_.setMargin(0); }

  /// The shape must outlive its use here.
  void setShape(const btConvexShape& shape);
  /// Whether this is the shape set last, and a hull still has the same corners. For other shapes the caller compares
  /// boxes.
  bool isStillOf(const btConvexShape& shape) const;
  /// Whether queries take tens of nanoseconds; GJK takes a microsecond and EPA several.
  bool isClosedForm() const { return bullet::isClosedForm(*shape_); }
  /// The surface point nearest to `p`.
  NearestPoint nearest(const Vec3& p);
  /// Lower bound on the distance from a point outside; cheap for hulls.
  float apartFrom(const Vec3& p);
  /// The margin around the core that queries work on: 0 for closed forms, except for spheres, whose core is their
  /// centre.
  float margin() const;
  /// The nearest point to the hull of at most `kMaxHullPoints` points, always by GJK; empty when GJK gives up.
  std::optional<NearestPoint> nearestToHull(std::span<const Vec3> points);
  /// The shape's point that lies farthest along a unit direction.
  Vec3 support(const Vec3& direction) const;

 private:
  NearestPoint nearestByGjk(const Vec3& p);
  std::optional<NearestPoint> askGjk(const btConvexShape& other, const Vec3& origin);
  NearestPoint supportingPlane(const Vec3& p) const;

  const btConvexShape* shape_ = nullptr;
  std::shared_ptr<const HullFaces> hull_;
  btSphereShape point_;
  btConvexPointCloudShape points_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver penetration_;
};

}  // namespace cairn::bullet
