// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"
#include "contacts/cut_face.h"

namespace cairn::bullet {

/// The part of a convex shape that faces a direction: a face's corners, an edge's ends, points on a round face's
/// border, or one point. Support queries find it from outside, along the direction and along eight directions tilted a
/// little.
///
///     FacingCorners facing;
///     facing.look(direction, size, [&](const Vec3& d) { return body.support(d); });
///     for (const Vec3& corner : facing.corners()) ...;
class FacingCorners {
 public:
  static constexpr std::size_t kMaxCorners = kMaxFaceCorners;

  /// `support(direction)` returns the shape's farthest point. `direction` is a unit vector. `size` is the shape's;
  /// corners nearer to each other than an eightieth of it count as one. Cost: at most nine support queries.
  void look(const Vec3& direction, float size, const auto& support) {
    const Vec3 u = normalized(perpendicularTo(direction)), v = cross(direction, u);
    std::array<Vec3, kMaxCorners> tilted;
    for (std::size_t i = 0; i < kMaxCorners; ++i)
      tilted[i] = support(normalized(direction + (u * kTilts[i][0] + v * kTilts[i][1]) * kTilt));
    count_ = 0;
    for (const Vec3& corner : tilted) add(corner, size);
    if (count_ == 1) corners_[0] = support(direction);
    if (count_ == 2) takeFarthestPair(tilted);
  }

  /// Moves all corners, in the frame of the support points.
  void move(const Vec3& by) {
    for (std::size_t i = 0; i < count_; ++i) corners_[i] += by;
  }

  /// In order around the direction.
  std::span<const Vec3> corners() const { return std::span(corners_).first(count_); }

 private:
  // In radians. A shape tilted by more touches with fewer corners. Two corners a quarter of its size apart then differ
  // in height by more than the contact distance of 0.002 sizes. A smaller tilt would find less of the ends of round
  // edges.
  static constexpr float kTilt = 0.01F;
  // Fraction of the size. Opposite tilts find points of a round shape that are up to twice the tilt times its radius
  // apart, 0.01 sizes. These must count as one.
  static constexpr float kSameFraction = 0.0125F;
  static constexpr float kDiagonal = 0.70710678F;
  static constexpr std::array<std::array<float, 2>, kMaxCorners> kTilts{{{1, 0},
                                                                         {kDiagonal, kDiagonal},
                                                                         {0, 1},
                                                                         {-kDiagonal, kDiagonal},
                                                                         {-1, 0},
                                                                         {-kDiagonal, -kDiagonal},
                                                                         {0, -1},
                                                                         {kDiagonal, -kDiagonal}}};

  static Vec3 perpendicularTo(const Vec3& d) {
    const Vec3 axis = d.x * d.x < 0.5F ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    return cross(d, axis);
  }
  void add(const Vec3& corner, float size) {
    for (const Vec3& known : corners())
      if (lengthSq(corner - known) < kSameFraction * kSameFraction * size * size) return;
    corners_[count_++] = corner;
  }
  // Ends that a tilt across a round edge finds lie beside its lowest line. One such end alone would make a lying
  // cylinder roll; ends of opposite tilts balance each other.
  void takeFarthestPair(const std::array<Vec3, kMaxCorners>& tilted) {
    constexpr std::size_t kHalf = kMaxCorners / 2;
    float farthestSq = -1;
    for (std::size_t i = 0; i < kHalf; ++i) {
      const float distanceSq = lengthSq(tilted[i] - tilted[i + kHalf]);
      if (distanceSq <= farthestSq) continue;
      farthestSq = distanceSq;
      corners_[0] = tilted[i];
      corners_[1] = tilted[i + kHalf];
    }
  }

  std::array<Vec3, kMaxCorners> corners_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
