// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"
#include "contacts/cut_face.h"

namespace cairn::bullet {

/// What a convex shape turns towards a direction: the corners of a face, the ends of an edge, points of a round face's
/// border, or one point. Found from outside, by asking where the shape reaches farthest along the direction and along
/// some tilted a little from it.
class FacingCorners {
 public:
  static constexpr std::size_t kMaxCorners = kMaxFaceCorners;

  /// `support(direction)`: the shape's farthest point. `direction`: unit. `size`: of the shape; corners nearer to each
  /// other than an eightieth of that are one. Nine questions at most.
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

  /// All corners, in the frame of the supports.
  void move(const Vec3& by) {
    for (std::size_t i = 0; i < count_; ++i) corners_[i] += by;
  }

  /// In their order around the direction.
  std::span<const Vec3> corners() const { return std::span(corners_).first(count_); }

 private:
  // What leans by more touches with fewer corners: over a quarter of its size, two of them are then more than two
  // thousandths of it apart in height, farther than contacts reach. Less would find less of round edges' ends.
  static constexpr float kTilt = 0.01F;
  // Twice the tilt times a round shape's radius, half its size, lies between what opposite tilts find on it.
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
  // Tilted across a round edge, its ends lie beside where it is lowest: one end alone would set a lying cylinder
  // rolling, ends of opposite tilts hold each other.
  void takeFarthestPair(const std::array<Vec3, kMaxCorners>& tilted) {
    constexpr std::size_t kHalf = kMaxCorners / 2;
    float farthestSq = -1;
    for (std::size_t i = 0; i < kHalf; ++i) {
      const float apartSq = lengthSq(tilted[i] - tilted[i + kHalf]);
      if (apartSq <= farthestSq) continue;
      farthestSq = apartSq;
      corners_[0] = tilted[i];
      corners_[1] = tilted[i + kHalf];
    }
  }

  std::array<Vec3, kMaxCorners> corners_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
