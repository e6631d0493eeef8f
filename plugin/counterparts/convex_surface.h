// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btConvexShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <array>
#include <optional>
#include <span>

#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The surface point of a convex shape that is nearest to a given one.
struct NearestPoint {
  Vec3 point;
  Vec3 normal;         ///< unit, outwards; the shape lies behind the plane through `point`
  float distance = 0;  ///< negative inside
};

/// Distance queries against one convex shape, in the shape's frame, its margin included. Boxes and spheres are answered
/// in closed form, everything else by GJK, and by EPA inside.
class ConvexSurface {
 public:
  /// What a leaf has: its support points and its region's corners.
  static constexpr std::size_t kMaxHullPoints = kMaxSupportPoints + kMaxRegionCorners;

  ConvexSurface() : point_(0) { hull_.setMargin(0); }

  /// The shape must outlive its use here.
  void setShape(const btConvexShape& shape) { shape_ = &shape; }
  NearestPoint nearest(const Vec3& p);
  /// Whether that is answered in closed form: tens of nanoseconds, where GJK takes a microsecond and EPA several.
  bool isClosedForm() const;
  /// The same for the hull of at most `kMaxHullPoints` points instead of a single one, always by GJK; nothing when that
  /// gives up.
  std::optional<NearestPoint> nearestToHull(std::span<const Vec3> points);
  /// The shape's point that lies farthest along a unit direction.
  Vec3 support(const Vec3& direction) const;

 private:
  NearestPoint nearestByGjk(const Vec3& p);
  std::optional<NearestPoint> askGjk(const btConvexShape& other, const Vec3& origin);
  NearestPoint supportingPlane(const Vec3& p) const;

  const btConvexShape* shape_ = nullptr;
  btSphereShape point_;
  btConvexPointCloudShape hull_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver penetration_;
};

/// Closed forms, for a box of these half extents and a sphere of this radius, both at the origin.
NearestPoint nearestOnBox(const Vec3& halfExtents, const Vec3& p);
NearestPoint nearestOnSphere(float radius, const Vec3& p);

}  // namespace cairn::bullet
