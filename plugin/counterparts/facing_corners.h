// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// What a convex shape turns towards a direction: the corners of a face, the ends of an edge, points of a round face's
/// border, or one point. Found from outside, by asking where the shape reaches farthest along the direction and along
/// some tilted a little from it.
class FacingCorners {
 public:
  static constexpr std::size_t kMaxCorners = 9;

  /// `support(direction)`: the shape's farthest point. `direction`: unit. `size`: of the shape; corners nearer to each
  /// other than a twentieth of that are one. Nine questions.
  void look(const Vec3& direction, float size, const auto& support) {
    count_ = 0;
    add(support(direction), size);
    const Vec3 u = normalized(perpendicularTo(direction)), v = cross(direction, u);
    for (const auto& [alongU, alongV] : kTilts)
      add(support(normalized(direction + (u * alongU + v * alongV) * kTilt)), size);
  }

  /// The first is the farthest along the direction.
  std::span<const Vec3> corners() const { return std::span(corners_).first(count_); }

 private:
  // What leans by more touches with fewer corners: over a quarter of its size, two of them are then five thousandths of
  // it apart in height, farther than contacts reach.
  static constexpr float kTilt = 0.02F;
  static constexpr float kSameFraction = 0.05F;
  static constexpr float kDiagonal = 0.70710678F;
  // The corners of a square first, as its edges' middles are no corners.
  static constexpr std::array<std::array<float, 2>, kMaxCorners - 1> kTilts{{{kDiagonal, kDiagonal},
                                                                             {-kDiagonal, kDiagonal},
                                                                             {-kDiagonal, -kDiagonal},
                                                                             {kDiagonal, -kDiagonal},
                                                                             {1, 0},
                                                                             {0, 1},
                                                                             {-1, 0},
                                                                             {0, -1}}};

  static Vec3 perpendicularTo(const Vec3& d) {
    const Vec3 axis = d.x * d.x < 0.5F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    return cross(d, axis);
  }
  void add(const Vec3& corner, float size) {
    for (const Vec3& known : corners())
      if (lengthSq(corner - known) < kSameFraction * kSameFraction * size * size) return;
    corners_[count_++] = corner;
  }

  std::array<Vec3, kMaxCorners> corners_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
