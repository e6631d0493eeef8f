// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/rocks/rock_maker.h"

#include <LinearMath/btConvexHullComputer.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "scenes/bodies/icosphere.h"
#include "scenes/bodies/worn_surface.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

using builder::TriangleMesh;
using scenes::Random;

constexpr std::uint64_t kAxesStream = 1, kPointStream = 2, kDentStream = 3, kCutStream = 4;
constexpr std::uint32_t kRoundedSubdivisions = 2, kConcaveSubdivisions = 3;

/// Half axes of a rock's ellipsoid, from Zingg's (1935) equant and discoid classes: c/b above and below 2/3.
Vec3d halfAxes(RockKind kind, std::uint64_t seed) {
  Random random(seed, kAxesStream);
  const double middle = random.uniform(0.72, 0.95);
  switch (kind) {
    case RockKind::angular:
      return Vec3d(1, middle, middle * random.uniform(0.7, 0.95)) * 0.5;
    case RockKind::slabby:
      return Vec3d(1, middle, middle * random.uniform(0.2, 0.4)) * 0.5;
    case RockKind::rounded:
      break;
  }
  return Vec3d(1, middle, middle * random.uniform(0.8, 0.98)) * 0.5;
}

Vec3d scaled(const Vec3d& p, const Vec3d& axes) {
  return {p.x * axes.x, p.y * axes.y, p.z * axes.z};
}

/// Random directions with a least distance, so that no facet is a sliver.
std::vector<Vec3d> strewnDirections(Random& random, std::size_t count) {
  std::vector<Vec3d> directions;
  double apart = 0.6;
  while (directions.size() < count) {
    const Vec3d candidate = random.direction();
    const bool fits = std::ranges::all_of(directions, [&](const Vec3d& d) { return distance(d, candidate) >= apart; });
    if (fits)
      directions.push_back(candidate);
    else
      apart *= 0.995;  // until all directions fit
  }
  return directions;
}

/// Triangles of the hull of points in convex position, counter-clockwise from outside.
TriangleMesh hullOf(const std::vector<Vec3d>& points) {
  std::vector<double> coordinates;
  for (const Vec3d& p : points) coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  btConvexHullComputer hull;
  hull.compute(coordinates.data(), static_cast<int>(3 * sizeof(double)), static_cast<int>(points.size()), 0, 0);
  TriangleMesh mesh;
  for (int i = 0; i < hull.vertices.size(); ++i)
    mesh.vertices.push_back(points[static_cast<std::size_t>(hull.original_vertex_index[i])]);
  for (int f = 0; f < hull.faces.size(); ++f) {
    const btConvexHullComputer::Edge* first = &hull.edges[hull.faces[f]];
    const auto apex = static_cast<std::uint32_t>(first->getSourceVertex());
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != static_cast<int>(apex);
         edge = edge->getNextEdgeOfFace())
      mesh.triangles.push_back({apex, static_cast<std::uint32_t>(edge->getSourceVertex()),
                                static_cast<std::uint32_t>(edge->getTargetVertex())});
  }
  return mesh;
}

TriangleMesh convexRock(RockKind kind, std::uint64_t seed) {
  const Vec3d axes = halfAxes(kind, seed);
  if (kind == RockKind::rounded) {
    TriangleMesh mesh = scenes::icosphere(kRoundedSubdivisions);
    for (Vec3d& v : mesh.vertices) v = scaled(v, axes);
    return mesh;
  }
  Random random(seed, kPointStream);
  std::vector<Vec3d> points = strewnDirections(random, 16 + random.bits() % 9);
  for (Vec3d& p : points) p = scaled(p, axes);
  return hullOf(points);
}

/// The worn surface of a concave rock, as a fraction of its ellipsoid.
scenes::WornSurface wornRock(RockKind kind, std::uint64_t seed) {
  scenes::WornSurface worn(mixBits(seed));
  Random dents(seed, kDentStream), cuts(seed, kCutStream);
  if (kind != RockKind::rounded)
    for (const Vec3d& normal : strewnDirections(cuts, 9 + cuts.bits() % 5)) worn.cut(normal, cuts.uniform(0.68, 0.85));
  // Dents keep a distance, because overlapping dents would only flatten the rock.
  for (const Vec3d& direction : strewnDirections(dents, 2 + dents.bits() % 3)) {
    const double width = dents.uniform(0.5, 0.75);
    worn.dent(direction, width, dents.uniform(0.3, 0.45));
  }
  return worn;
}

TriangleMesh concaveRock(RockKind kind, std::uint64_t seed) {
  const Vec3d axes = halfAxes(kind, seed);
  const scenes::WornSurface worn = wornRock(kind, seed);
  const double roughness = kind == RockKind::rounded ? 0.25 : 1;
  TriangleMesh mesh = scenes::icosphere(kConcaveSubdivisions);
  for (Vec3d& v : mesh.vertices) v = scaled(v * worn.radius(v, roughness), axes);
  return mesh;
}

const char* nameOf(RockKind kind) {
  return kind == RockKind::angular ? "angular" : kind == RockKind::slabby ? "slabby" : "rounded";
}

}  // namespace

TriangleMesh makeRock(RockKind kind, bool concave, std::uint64_t seed) {
  TriangleMesh mesh = concave ? concaveRock(kind, seed) : convexRock(kind, seed);
  mesh.name = fmt::format("{}{}-{}", concave ? "concave-" : "", nameOf(kind), seed);
  return mesh;
}

}  // namespace cairn::rockfall
