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

/// Distance queries against one convex shape, in the shape's frame, its margin included. Boxes and round shapes are
/// answered in closed form, hulls by their faces, everything else by GJK, and by EPA inside.
class ConvexSurface {
 public:
  /// What a leaf has: its support points and its region's corners.
  static constexpr std::size_t kMaxHullPoints = kMaxSupportPoints + kMaxRegionCorners;

  ConvexSurface() : point_(0) { points_.setMargin(0); }

  /// The shape must outlive its use here.
  void setShape(const btConvexShape& shape);
  /// Whether it is that shape, and a hull still has the corners it had then. Of other shapes their box tells.
  bool isStillOf(const btConvexShape& shape) const;
  /// Whether questions take tens of nanoseconds, where GJK takes a microsecond and EPA several.
  bool isClosedForm() const { return bullet::isClosedForm(*shape_); }
  NearestPoint nearest(const Vec3& p);
  /// No more than the distance of a point outside; cheap for hulls.
  float apartFrom(const Vec3& p);
  /// What the shape adds to a core that is asked about; none where it is answered in closed form, but for spheres,
  /// whose core is their middle.
  float margin() const;
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
  std::shared_ptr<const HullFaces> hull_;
  btSphereShape point_;
  btConvexPointCloudShape points_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver penetration_;
};

}  // namespace cairn::bullet
