// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/rock.h"

#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/bodies/icosphere.h"
#include "scenes/bodies/worn_surface.h"
#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

using builder::TriangleMesh;

/// The surface of a rock as a function of direction.
class RockProfile {
 public:
  explicit RockProfile(std::uint64_t seed) : worn_(mixBits(seed)) {
    Random random(seed, kShapeStream);
    const std::size_t cutCount = 7 + random.bits() % 4;
    for (std::size_t i = 0; i < cutCount; ++i) {
      const Vec3d normal = random.direction();
      worn_.cut(normal, random.uniform(0.66, 0.9));
    }
    const std::size_t dentCount = 2 + random.bits() % 3;
    for (std::size_t i = 0; i < dentCount; ++i) {
      const Vec3d direction = dentDirection(random);
      const double width = random.uniform(0.5, 0.75);
      worn_.dent(direction, width, random.uniform(0.3, 0.45));
    }
    axes_ = {1, random.uniform(0.75, 0.95), random.uniform(0.6, 0.85)};
  }

  Vec3d point(const Vec3d& direction) const {
    const double radius = worn_.radius(direction);
    assert(radius > 0);
    const Vec3d p = direction * (0.5 * radius);
    return {p.x * axes_.x, p.y * axes_.y, p.z * axes_.z};
  }

 private:
  static constexpr std::uint64_t kShapeStream = 1;

  /// Keeps a distance from existing dents, because overlapping dents would only flatten the rock.
  Vec3d dentDirection(Random& random) const {
    while (true) {
      const Vec3d direction = random.direction();
      if (worn_.isFree(direction, 0.8)) return direction;
    }
  }

  WornSurface worn_;
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
