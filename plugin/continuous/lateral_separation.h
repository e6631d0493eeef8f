// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Whether two convex things, one of which moves straight on, pass beside each other: seen along the way they do not
/// overlap. A search for the difference's point that is nearest to the origin (Gilbert, Johnson, Keerthi 1988) in the
/// plane at right angles to the way, ended by the first direction along which they are apart. All vectors are in one
/// frame and unit. Work: `kMaxRounds` questions at most; nothing fails.
class LateralSeparation {
 public:
  static constexpr int kMaxRounds = 12;

  /// `along`: the way, unit.
  explicit LateralSeparation(const Vec3& along) : along_(along) {}

  /// A unit direction at right angles to the way along which they are farther apart than `margin`; nothing where they
  /// overlap, or it takes too long to tell. `first`: about where the one is, seen from the other.
  /// `difference(direction)`: the one's farthest point against a unit direction minus the other's along it.
  std::optional<Vec3> direction(const Vec3& first, float margin, const auto& difference) {
    Vec3 nearest = across(first);
    for (int round = 0; round < kMaxRounds; ++round) {
      const float distance = length(nearest);
      if (!(distance > 0)) return std::nullopt;
      const Vec3 tried = nearest / distance;
      const Vec3 point = across(difference(tried));
      const float apart = dot(tried, point);
      if (apart > margin) return tried;
      // What has no end along it has none anywhere near.
      if (!(apart > -kFarthest) || !add(point)) return std::nullopt;
      nearest = nearestToOrigin();
    }
    return std::nullopt;
  }

 private:
  static constexpr float kFarthest = 1e18F;

  Vec3 across(const Vec3& v) const { return v - along_ * dot(along_, v); }
  float turn(const Vec3& a, const Vec3& b) const { return dot(along_, cross(a, b)); }
  // False for a corner that is known already: there is nothing nearer.
  bool add(const Vec3& point);
  bool surroundsOrigin() const;
  // Zero if the origin lies among the corners; else keeps the side that it is nearest to.
  Vec3 nearestToOrigin();

  Vec3 along_;
  std::array<Vec3, 3> corners_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
