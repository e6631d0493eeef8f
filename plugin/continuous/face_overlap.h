// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Finds where two regions touch that come together along a normal. It is the common part of the faces (edges, corners)
/// that face each other, seen along the normal.
///
///     FaceOverlap overlap;
///     overlap.find(normal, ofTree.corners(), ofOther.corners());
///     for (const Vec3& point : overlap.points()) ...;
class FaceOverlap {
 public:
  static constexpr std::size_t kMax = 4;

  /// `normal`: unit, away from the second region. `first`, `second`: the corners of either region that face the other,
  /// in order (`FacingCorners`), at the time of touch. All in one frame and unit; neither is empty. If the two lie
  /// beside each other, the result is the second's point nearest to the first. Cost: a cut of the second for each side
  /// of the first.
  void find(const Vec3& normal, std::span<const Vec3> first, std::span<const Vec3> second);

  /// On the second region; at least one.
  std::span<const Vec3> points() const { return std::span(points_).first(count_); }

 private:
  void takeSome(std::span<const Vec3> common);

  std::array<Vec3, kMax> points_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
