// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cairn::builder {

namespace {

/// Vertices beyond this fraction of the largest distance count as equally far.
constexpr double kAboutAsFar = 0.999;
/// Triangles whose least altitude is below this number of grid steps are too narrow to round their corners. A step is
/// `kBodyRounding`. Rounding by half a step along each axis moves a corner by less than a step.
constexpr double kNarrow = 16;
/// Largest fraction of a solid's volume that rounding may change.
constexpr double kVolumeLost = 0.01;

struct Farthest {
  std::size_t vertex = 0;
  double distance = 0;
};

/// The first vertex that is about as far as the farthest.
Farthest firstFarthest(const TriangleMesh& mesh, const std::function<double(const Vec3d&)>& distanceOf) {
  double most = 0;
  for (const Vec3d& v : mesh.vertices) most = std::max(most, distanceOf(v));
  std::size_t first = 0;
  while (distanceOf(mesh.vertices[first]) < kAboutAsFar * most) ++first;
  return {first, most};
}

Vec3d meanOf(const std::vector<Vec3d>& points) {
  Vec3d sum;  // of differences, because a mesh far from the origin would lose digits
  for (const Vec3d& p : points) sum += p - points[0];
  return points[0] + sum / static_cast<double>(points.size());
}

Vec3d across(const Vec3d& v, const Vec3d& axis) {
  return v - axis * dot(v, axis);
}

double leastAltitude(const std::array<Vec3d, 3>& c) {
  const double longest = std::max({distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])});
  return length(cross(c[1] - c[0], c[2] - c[0])) / longest;
}

bool canBeRounded(const TriangleMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!(leastAltitude(mesh.corners(t)) >= kNarrow * kBodyRounding)) return false;
  return true;
}

/// Six times its volume.
double sixVolumes(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Vec3d, 3> c = mesh.corners(t);
    sum += dot(c[0], cross(c[1], c[2]));
  }
  return sum;
}

/// A solid thinner than some steps of the grid would be flat.
bool isAsThick(const TriangleMesh& roundedMesh, const TriangleMesh& mesh) {
  const double volume = sixVolumes(mesh);
  return std::abs(sixVolumes(roundedMesh) - volume) <= kVolumeLost * std::abs(volume);
}

Vec3d rounded(const Vec3d& p) {
  return Vec3d(std::nearbyint(p.x / kBodyRounding), std::nearbyint(p.y / kBodyRounding),
               std::nearbyint(p.z / kBodyRounding)) *
         kBodyRounding;
}

}  // namespace

BodyFrame::BodyFrame(const TriangleMesh& mesh) : origin_(meanOf(mesh.vertices)) {
  const Farthest far = firstFarthest(mesh, [&](const Vec3d& v) { return distance(v, origin_); });
  unit_ = far.distance;
  axes_[0] = normalized(mesh.vertices[far.vertex] - origin_);
  const Farthest side =
      firstFarthest(mesh, [&](const Vec3d& v) { return length(across(v - origin_, axes_[0])) / unit_; });
  axes_[1] = normalized(across((mesh.vertices[side.vertex] - origin_) / unit_, axes_[0]));
  axes_[2] = cross(axes_[0], axes_[1]);
}

Vec3d BodyFrame::into(const Vec3d& point) const {
  const Vec3d p = (point - origin_) / unit_;
  return {dot(p, axes_[0]), dot(p, axes_[1]), dot(p, axes_[2])};
}

Vec3d BodyFrame::outOf(const Vec3d& point) const {
  return origin_ + (axes_[0] * point.x + axes_[1] * point.y + axes_[2] * point.z) * unit_;
}

Ball BodyFrame::outOf(const Ball& ball) const {
  return {outOf(ball.center), ball.radius * unit_, ball.depth * unit_};
}

TriangleMesh bodyMesh(const TriangleMesh& mesh, const BodyFrame& frame) {
  TriangleMesh body = mesh;
  std::transform(body.vertices.begin(), body.vertices.end(), body.vertices.begin(),
                 [&](const Vec3d& v) { return frame.into(v); });
  if (!canBeRounded(body)) return body;
  TriangleMesh onGrid = body;
  std::transform(body.vertices.begin(), body.vertices.end(), onGrid.vertices.begin(), rounded);
  return isAsThick(onGrid, body) ? onGrid : body;
}

}  // namespace cairn::builder
