// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/crush_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/figures/random.h"
#include "scenes/truth/placed_body.h"

namespace cairn::scenes {
namespace {

constexpr double kSpacingFraction = 0.33;
/// Largest distance of a body from its grid point, as a fraction of the spacing.
constexpr double kShakeFraction = 0.15;
constexpr double kWidening = 1.05;
/// Distance between ground and lowest body, as a fraction of body size.
constexpr double kGroundRoomFraction = 0.01;

std::vector<btTransform> shakenGrid(const Model& model, std::uint32_t bodies, std::uint64_t seed, double spacing) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::cbrt(bodies) - 1e-9));
  const double middle = (side - 1) * 0.5;
  std::vector<btTransform> poses;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < bodies; ++i) {
    Random random(seed, i);
    const btQuaternion rotation = random.rotation();
    const Vec3d point{i % side - middle, i / side % side - middle, static_cast<double>(i / (side * side))};
    const Vec3d place = (point + random.direction() * kShakeFraction) * spacing;
    poses.emplace_back(rotation, toBullet(place));
    lowest = std::min(lowest, placeBody(poses.back(), model).box.lower.z);
  }
  const double lift = kGroundRoomFraction * model.size - lowest;
  for (btTransform& pose : poses) pose.getOrigin() += toBullet({0, 0, lift});
  return poses;
}

}  // namespace

Result<CrushStart> crushStart(const Model& model, std::uint32_t bodies, std::uint64_t seed) {
  const auto surface = ExactSurface::create(model.vertices, model.triangles);
  if (!surface) return surface.error();
  for (double spacing = kSpacingFraction * model.size;; spacing *= kWidening) {
    CrushStart start{shakenGrid(model, bodies, seed, spacing), {}};
    start.depth = penetrations(surface.value(), model, start.poses);
    if (start.depth.max <= kDeepestStartFraction) return start;
  }
}

}  // namespace cairn::scenes
