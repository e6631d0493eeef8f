// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Decides whether two convex bodies, one moving straight, pass beside each other: seen along the motion they do not
/// overlap.
///
///     const auto direction = LateralSeparation(along).direction(first, margin, difference);
///     if (direction) return;  // they pass
///
/// It searches the point of the bodies' difference nearest to the origin (Gilbert, Johnson, Keerthi 1988), in the plane
/// perpendicular to the motion. It stops at the first direction that separates them. All vectors are in one frame and
/// unit. Cost: at most `kMaxRounds` support queries of each body. It cannot fail.
class LateralSeparation {
 public:
  static constexpr int kMaxRounds = 12;

  /// `along`: the direction of motion, unit.
  explicit LateralSeparation(const Vec3& along) : along_(along) {}

  /// A unit direction perpendicular to the motion along which they are farther apart than `margin`. Empty if they
  /// overlap, or if the search takes too long. `first`: a rough direction from the other to the one.
  /// `difference(direction)`: the farthest point of the one against a unit direction, minus the other's farthest along
  /// it.
  std::optional<Vec3> direction(const Vec3& first, float margin, const auto& difference) {
    Vec3 nearest = across(first);
    for (int round = 0; round < kMaxRounds; ++round) {
      const float distance = length(nearest);
      if (!(distance > 0)) return std::nullopt;
      const Vec3 tried = nearest / distance;
      const Vec3 point = across(difference(tried));
      const float apart = dot(tried, point);
      if (apart > margin) return tried;
      // A body without an end along this direction has none along any near one.
      if (!(apart > -kFarthest) || !add(point)) return std::nullopt;
      nearest = nearestToOrigin();
    }
    return std::nullopt;
  }

 private:
  static constexpr float kFarthest = 1e18F;

  Vec3 across(const Vec3& v) const { return v - along_ * dot(along_, v); }
  float crossAlong(const Vec3& a, const Vec3& b) const { return dot(along_, cross(a, b)); }
  // Returns false for a known corner: nothing is nearer.
  bool add(const Vec3& point);
  bool surroundsOrigin() const;
  // Zero if the origin lies among the corners; else keeps the side nearest to it.
  Vec3 nearestToOrigin();

  Vec3 along_;
  std::array<Vec3, 3> corners_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
