// SPDX-License-Identifier: Zlib
#include "refit_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Of a cone's cosine: some roundings of a unit vector's coordinates and of a product.
constexpr float kConeRounding = 1e-6F;

// The next float that is no less.
float roundedUp(double x) {
  const auto f = static_cast<float>(x);
  return double(f) < x ? std::nextafter(f, kInfinity) : f;
}
float roundedDown(double x) {
  const auto f = static_cast<float>(x);
  return double(f) > x ? std::nextafter(f, -kInfinity) : f;
}

float leastCosine(const MovedMesh& mesh, std::span<const std::uint32_t> region, const Vec3& axis) {
  float least = 1;
  for (const std::uint32_t triangle : region) {
    const Vec3& normal = mesh.surface.features().faces()[triangle].normal;
    if (normal != Vec3()) least = std::min(least, dot(normal, axis) - kConeRounding);
  }
  return std::max(least, -1.0F);
}

// About the mean of the normals, or about the first cone's axis as it turned, whichever is narrower.
NormalCone coneOf(const MovedMesh& mesh, std::uint32_t record, const LocalMotion& motion) {
  const std::span<const std::uint32_t> region = mesh.first.regionTriangles(mesh.first.nodeAt(record));
  const Vec3 turned(normalized(motion.rotation * Vec3d(mesh.first.data().nodes[record].normalCone.axis)));
  Vec3d sum;
  for (const std::uint32_t triangle : region) sum += Vec3d(mesh.surface.features().faces()[triangle].normal);
  NormalCone cone{turned, leastCosine(mesh, region, turned)};
  if (!(lengthSq(sum) > 0)) return cone;
  const Vec3 mean(normalized(sum));
  if (const float cosine = leastCosine(mesh, region, mean); cosine > cone.cosine) cone = {mean, cosine};
  return cone;
}

}  // namespace

LocalMotion motionOf(const MovedMesh& mesh, std::uint32_t record) {
  const RefitBinding::Node& node = mesh.binding.nodes[record];
  const std::span<const std::uint32_t> places = mesh.binding.placesOf(record);
  LocalMotion motion{node.middle, {}, {}, 1};
  for (const std::uint32_t place : places) motion.to += mesh.places[place];
  motion.to = motion.to / double(places.size());
  Mat3d sum{{Vec3d(), Vec3d(), Vec3d()}};
  double before = 0, now = 0;
  for (const std::uint32_t place : places) {
    const Vec3d from = mesh.binding.places[place] - motion.from, to = mesh.places[place] - motion.to;
    addOuter(sum, to, from);
    before += lengthSq(from);
    now += lengthSq(to);
  }
  for (const std::uint32_t triangle : mesh.first.regionTriangles(mesh.first.nodeAt(record)))
    addOuter(sum, Vec3d(mesh.surface.features().faces()[triangle].normal),
             Vec3d(mesh.first.surface().features.faces()[triangle].normal) *
                 (node.weightOfNormals * mesh.binding.areas[triangle]));
  motion.rotation = nearestRotation(sum);
  if (before > 0) motion.scale = std::sqrt(now / before);
  return motion;
}

NodeData refittedNode(const MovedMesh& mesh, std::uint32_t record, SurfaceDepthSearch& search) {
  NodeData n = mesh.first.data().nodes[record];
  const LocalMotion motion = motionOf(mesh, record);
  n.center = Vec3(motion(Vec3d(n.center)));
  const Vec3d center(n.center);
  double farthestSq = 0;
  for (const std::uint32_t place : mesh.binding.placesOf(record))
    farthestSq = std::max(farthestSq, lengthSq(mesh.places[place] - center));
  n.radius = roundedUp(std::sqrt(farthestSq) + mesh.rounding);
  const double depth = search.at(mesh.surface, n.center, mesh.binding.nodes[record].nearest).depth - mesh.rounding;
  n.error = std::max(0.0F, roundedUp(double(n.radius) - depth));
  n.innerRadius = std::clamp(roundedDown(depth), 0.0F, n.radius);
  n.normalCone = coneOf(mesh, record, motion);
  return n;
}

}  // namespace cairn
