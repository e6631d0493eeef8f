// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/rocks/rock_maker.h"

#include <LinearMath/btConvexHullComputer.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "scenes/bodies/icosphere.h"
#include "scenes/bodies/lattice_noise.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

using builder::TriangleMesh;
using scenes::Random;

constexpr std::uint64_t kAxesStream = 1, kPointStream = 2, kDentStream = 3, kCutStream = 4;
constexpr std::uint32_t kRoundedSubdivisions = 2, kConcaveSubdivisions = 3;

/// Half axes of the ellipsoid a rock is made of: from Zingg's (1935) equant and discoid classes, c/b above and below
/// 2/3.
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

/// Directions that keep away from each other, so that no facet is a sliver.
std::vector<Vec3d> strewnDirections(Random& random, std::size_t count) {
  std::vector<Vec3d> directions;
  double apart = 0.6;
  while (directions.size() < count) {
    const Vec3d candidate = random.direction();
    const bool fits = std::ranges::all_of(directions, [&](const Vec3d& d) { return distance(d, candidate) >= apart; });
    if (fits)
      directions.push_back(candidate);
    else
      apart *= 0.995;  // until all find room
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

/// How far the surface of a concave rock is from its centre along a direction, as a share of its ellipsoid's.
class ConcaveProfile {
 public:
  ConcaveProfile(RockKind kind, std::uint64_t seed) : noise_(mixBits(seed)), isRounded_(kind == RockKind::rounded) {
    Random dents(seed, kDentStream), cuts(seed, kCutStream);
    if (!isRounded_) addCuts(cuts);
    addDents(dents);
  }

  double share(const Vec3d& direction) const {
    double share = 1;
    for (const Cut& cut : cuts_) {
      const double facing = dot(direction, cut.normal);
      if (facing > 0) share = std::min(share, cut.distance / facing);
    }
    for (const Dent& dent : dents_) {
      const double t = 1 - lengthSq(direction - dent.direction) / (dent.width * dent.width);
      if (t > 0) share *= 1 - dent.depth * t * t * (3 - 2 * t);
    }
    const double roughness = isRounded_ ? 0.25 : 1;
    return share * (1 + roughness * (0.05 * noise_(direction * 2.5) + 0.02 * noise_(direction * 7)));
  }

 private:
  struct Cut {
    Vec3d normal;
    double distance;
  };
  struct Dent {
    Vec3d direction;
    double width, depth;  // width is a chord of the unit sphere; depth a share of the distance
  };

  void addCuts(Random& random) {
    const std::size_t count = 9 + random.bits() % 5;
    for (const Vec3d& normal : strewnDirections(random, count)) cuts_.push_back({normal, random.uniform(0.68, 0.85)});
  }
  /// Apart, because two that overlap would merely flatten the rock.
  void addDents(Random& random) {
    const std::size_t count = 2 + random.bits() % 3;
    for (const Vec3d& direction : strewnDirections(random, count))
      dents_.push_back({direction, random.uniform(0.5, 0.75), random.uniform(0.3, 0.45)});
  }

  scenes::LatticeNoise noise_;
  bool isRounded_;
  std::vector<Cut> cuts_;
  std::vector<Dent> dents_;
};

TriangleMesh concaveRock(RockKind kind, std::uint64_t seed) {
  const Vec3d axes = halfAxes(kind, seed);
  const ConcaveProfile profile(kind, seed);
  TriangleMesh mesh = scenes::icosphere(kConcaveSubdivisions);
  for (Vec3d& v : mesh.vertices) v = scaled(v * profile.share(v), axes);
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
