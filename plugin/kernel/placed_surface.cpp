// SPDX-License-Identifier: Zlib
#include "kernel/placed_surface.h"

#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

Mat3 axesFromPair(const Pose& pose) {
  const Mat3d inverse = transpose(pose.rotation);
  return {{Vec3(inverse.rows[0]), Vec3(inverse.rows[1]), Vec3(inverse.rows[2])}};
}

PlacedSurface placed(const SurfaceView& mesh, const Pose& pose, const Pose& other) {
  const Mat3 axes = axesFromPair(pose);
  return {mesh,
          toSimilarity(pose),
          relativePose(other, pose),
          axes,
          axesFromPair(other) * transpose(axes),
          static_cast<float>(pose.scale)};
}

}  // namespace

PlacedSurface PlacedSurface::of(const SurfaceView& mesh, const Pose& pose) {
  return placed(mesh, pose, Pose{});
}

SurfacePair SurfacePair::of(const SurfaceView& a, const Pose& poseOfA, const SurfaceView& b, const Pose& poseOfB) {
  return {placed(a, poseOfA, poseOfB), placed(b, poseOfB, poseOfA)};
}

}  // namespace cairn::bullet
