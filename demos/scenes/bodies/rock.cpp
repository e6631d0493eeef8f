// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/rock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/bodies/icosphere.h"
#include "scenes/bodies/lattice_noise.h"
#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

using builder::TriangleMesh;

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
  TriangleMesh mesh = icosphere(options.subdivisions);
  const RockProfile profile(options.seed);
  for (Vec3d& v : mesh.vertices) v = profile.point(v);
  mesh.name = "rock-" + std::to_string(options.seed);
  return mesh;
}

}  // namespace cairn::scenes
