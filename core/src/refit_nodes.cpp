// SPDX-License-Identifier: Zlib
#include "refit_nodes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/outward_rounding.h"
#include "refit_tuning.h"

namespace cairn {

namespace {

float leastCosine(const MovedMesh& mesh, std::span<const std::uint32_t> region, const Vec3& axis) {
  float least = 1;
  for (const std::uint32_t triangle : region) {
    const Vec3& normal = mesh.surface.features().faces()[triangle].normal;
    if (normal != Vec3()) least = std::min(least, dot(normal, axis) - refit::kConeRounding);
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

// A ball around a centre that holds a node's places.
struct Fit {
  Vec3 center;
  float radius = 0, error = 0;
  double nearestPlace = 0;  // from the centre
  double depth = 0;         // of the centre, rounded down
  SurfaceDepth surface{};
};

// The distances of a node's places from a centre.
struct PlaceDistances {
  double farthest = 0, nearest = std::numeric_limits<double>::infinity();
};

PlaceDistances distancesFrom(const Vec3& center, const MovedMesh& mesh, std::uint32_t record) {
  PlaceDistances squared;
  for (const std::uint32_t place : mesh.binding.placesOf(record)) {
    const double sq = lengthSq(mesh.places[place] - Vec3d(center));
    squared.farthest = std::max(squared.farthest, sq);
    squared.nearest = std::min(squared.nearest, sq);
  }
  return {std::sqrt(squared.farthest), std::sqrt(squared.nearest)};
}

Fit fitAround(const MovedMesh& mesh, std::uint32_t record, const Vec3& center, std::uint32_t guess,
              SurfaceDepthSearch& search) {
  Fit fit{.center = center};
  const PlaceDistances places = distancesFrom(center, mesh, record);
  fit.nearestPlace = places.nearest;
  fit.radius = roundUp(places.farthest + mesh.rounding);
  fit.surface = search.at(mesh.surface, center, guess);
  fit.depth = fit.surface.depth - mesh.rounding;
  fit.error = std::max(0.0F, roundUp(double(fit.radius) - fit.depth));
  return fit;
}

// A ball much larger than its region may come out of the solid elsewhere when the solid changes its shape. Its centre
// then moves away from there, until the surface is as far as the region, while that makes the error smaller.
Fit bestFit(const MovedMesh& mesh, std::uint32_t record, const Vec3& center, SurfaceDepthSearch& search) {
  const std::span<const std::uint32_t> region = mesh.first.regionTriangles(mesh.first.nodeAt(record));
  Fit best = fitAround(mesh, record, center, mesh.binding.nodes[record].nearest, search);
  for (int i = 0; i < refit::kMaxShifts; ++i) {
    const double free = best.depth, more = (best.nearestPlace - free) / 2;
    if (!(free > 0) || more < refit::kWorthAShift * double(best.error)) break;
    if (std::ranges::find(region, best.surface.triangle) != region.end()) break;
    const Vec3 shifted(Vec3d(best.center) + best.surface.away * (more / length(best.surface.away)));
    const Fit fit = fitAround(mesh, record, shifted, best.surface.triangle, search);
    if (!(fit.error < best.error)) break;
    best = fit;
  }
  return best;
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
  const Fit fit = bestFit(mesh, record, Vec3(motion(Vec3d(n.center))), search);
  n.center = fit.center;
  n.radius = fit.radius;
  n.error = fit.error;
  n.innerRadius = std::clamp(roundDown(fit.depth), 0.0F, n.radius);
  n.normalCone = coneOf(mesh, record, motion);
  return n;
}

Sphere refittedBound(const MovedMesh& mesh, std::uint32_t record) {
  const Vec3d first(mesh.first.data().bounds[record].center);
  const Vec3 center(motionOf(mesh, record)(first));
  return {center, roundUp(distancesFrom(center, mesh, record).farthest + mesh.rounding)};
}

}  // namespace cairn
