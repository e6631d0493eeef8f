// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Of a face that is cut or looked for (`FacingCorners`).
inline constexpr std::size_t kMaxFaceCorners = 8;

/// A convex face of few corners (or an edge, or a point), of which planes cut away what lies behind them, one after the
/// other (Sutherland and Hodgman 1974). At most `kMaxCuts` planes.
template <std::size_t kMaxCuts>
class CutFace {
 public:
  /// `corners`: in their order around the face, at most `kMaxFaceCorners`.
  explicit CutFace(std::span<const Vec3> corners) {
    for (const Vec3& corner : corners) points_[count_++] = corner;
  }

  /// Keeps what has dot(inwards, x) >= offset. An edge's ends may come twice.
  void cut(const Vec3& inwards, float offset) {
    std::array<Vec3, kMaxPoints> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3 &from = points_[i], &to = points_[(i + 1) % count_];
      const float before = dot(inwards, from) - offset, after = dot(inwards, to) - offset;
      if (before >= 0) kept[count++] = from;
      if ((before >= 0) != (after >= 0)) kept[count++] = from + (to - from) * (before / (before - after));
    }
    points_ = kept;
    count_ = count;
  }

  std::span<const Vec3> points() const { return std::span(points_).first(count_); }

 private:
  // Each cut of a convex face adds one; rounding, which bends it, one more.
  static constexpr std::size_t kMaxPoints = kMaxFaceCorners + 2 * kMaxCuts;

  std::array<Vec3, kMaxPoints> points_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
