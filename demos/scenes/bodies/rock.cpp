// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/rock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

using builder::Triangle;
using builder::TriangleMesh;

TriangleMesh icosahedron() {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3d& v : mesh.vertices) v = normalized(v);
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

/// Quarters every triangle, new vertices pushed out to the unit sphere.
TriangleMesh subdivided(const TriangleMesh& coarse) {
  TriangleMesh fine;
  fine.vertices = coarse.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
  const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, isNew] =
        midpoints.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices.size()));
    if (isNew) fine.vertices.push_back(normalized(fine.vertices[a] + fine.vertices[b]));
    return entry->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    fine.triangles.insert(fine.triangles.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

/// Smooth noise in [-1, 1]: hashed values at the points of a unit lattice, blended by quintics (Perlin 2002).
class LatticeNoise {
 public:
  explicit LatticeNoise(std::uint64_t seed) : seed_(seed) {}

  double operator()(const Vec3d& p) const {
    const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    const Vec3d weight{fade(p.x - cell.x), fade(p.y - cell.y), fade(p.z - cell.z)};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double share = 1;
      Vec3d at = cell;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = (corner >> axis) & 1;
        at[axis] += upper;
        share *= upper ? weight[axis] : 1 - weight[axis];
      }
      sum += share * valueAt(at);
    }
    return sum;
  }

 private:
  static double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
  double valueAt(const Vec3d& p) const {
    std::uint64_t hash = seed_;
    for (int axis = 0; axis < 3; ++axis)
      hash = mixBits(hash + static_cast<std::uint64_t>(static_cast<std::int64_t>(p[axis])));
    return static_cast<double>(hash >> 11) * 0x1.0p-52 - 1;
  }

  std::uint64_t seed_;
};

/// Distance of the surface from the centre, as a function of direction.
class RockProfile {
 public:
  explicit RockProfile(std::uint64_t seed) : noise_(mixBits(seed)) {
    Random random(seed, kShapeStream);
    const std::size_t cutCount = 7 + random.bits() % 4;
    for (std::size_t i = 0; i < cutCount; ++i) cuts_.push_back({random.direction(), random.uniform(0.66, 0.9)});
    const std::size_t dentCount = 2 + random.bits() % 3;
    for (std::size_t i = 0; i < dentCount; ++i)
      dents_.push_back({dentDirection(random), random.uniform(0.5, 0.75), random.uniform(0.3, 0.45)});
    axes_ = {1, random.uniform(0.75, 0.95), random.uniform(0.6, 0.85)};
  }

  Vec3d point(const Vec3d& direction) const {
    double radius = 1;
    for (const Cut& cut : cuts_) {
      const double facing = dot(direction, cut.normal);
      if (facing > 0) radius = std::min(radius, cut.distance / facing);
    }
    for (const Dent& dent : dents_) {
      const double t = 1 - lengthSq(direction - dent.direction) / (dent.width * dent.width);
      if (t > 0) radius *= 1 - dent.depth * t * t * (3 - 2 * t);
    }
    radius *= 1 + 0.05 * noise_(direction * 2.5) + 0.02 * noise_(direction * 7);
    assert(radius > 0);
    const Vec3d p = direction * (0.5 * radius);
    return {p.x * axes_.x, p.y * axes_.y, p.z * axes_.z};
  }

 private:
  static constexpr std::uint64_t kShapeStream = 1;

  struct Cut {
    Vec3d normal;
    double distance;
  };
  struct Dent {
    Vec3d direction;
    double width, depth;  // width is a chord of the unit sphere; depth a share of the radius
  };

  /// Away from the dents there are: two that overlap would merely flatten the rock.
  Vec3d dentDirection(Random& random) const {
    while (true) {
      const Vec3d direction = random.direction();
      const bool apart = std::all_of(dents_.begin(), dents_.end(),
                                     [&](const Dent& d) { return distance(d.direction, direction) > 0.8; });
      if (apart) return direction;
    }
  }

  LatticeNoise noise_;
  std::vector<Cut> cuts_;
  std::vector<Dent> dents_;
  Vec3d axes_;
};

}  // namespace

TriangleMesh generateRock(const RockOptions& options) {
  assert(options.subdivisions >= 1 && options.subdivisions <= 6);
  TriangleMesh mesh = icosahedron();
  for (std::uint32_t i = 0; i < options.subdivisions; ++i) mesh = subdivided(mesh);
  const RockProfile profile(options.seed);
  for (Vec3d& v : mesh.vertices) v = profile.point(v);
  mesh.name = "rock-" + std::to_string(options.seed);
  return mesh;
}

}  // namespace cairn::scenes
