// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Where two regions that come together along a normal touch: what the faces (edges, corners) that they turn to each
/// other have in common, seen along it.
class FaceOverlap {
 public:
  static constexpr std::size_t kMax = 4;

  /// `normal`: unit, away from the second region. `first`, `second`: the corners of what either turns to the other, in
  /// their order around it (`FacingCorners`), as they meet, all in one frame and unit; neither is empty. Where they lie
  /// beside each other the second's point that is nearest to the first counts. Work: a cut of the second for each side
  /// of the first.
  void find(const Vec3& normal, std::span<const Vec3> first, std::span<const Vec3> second);

  /// On the second region; one at least.
  std::span<const Vec3> points() const { return std::span(points_).first(count_); }

 private:
  void takeSome(std::span<const Vec3> common);

  std::array<Vec3, kMax> points_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
