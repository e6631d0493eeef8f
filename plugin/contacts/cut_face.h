// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The most corners of a face that `CutFace` or `FacingCorners` takes.
inline constexpr std::size_t kMaxFaceCorners = 8;

/// A convex face of few corners, or an edge, or a point. Planes cut it one after the other, and the part behind each
/// plane is removed (Sutherland and Hodgman 1974). At most `kMaxCuts` planes.
///
///     CutFace<3> piece(corners);
///     piece.cut(inwards, offset);
///     for (const Vec3& point : piece.points()) ...;
template <std::size_t kMaxCuts>
class CutFace {
 public:
  /// `corners`: in order around the face, at most `kMaxFaceCorners`.
  explicit CutFace(std::span<const Vec3> corners) {
    for (const Vec3& corner : corners) points_[count_++] = corner;
  }

  /// Keeps the part with dot(inwards, x) >= offset. An edge's end may come twice.
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
  // A cut of a convex face adds one corner. Rounding makes the face slightly concave, which adds one more.
  static constexpr std::size_t kMaxPoints = kMaxFaceCorners + 2 * kMaxCuts;

  std::array<Vec3, kMaxPoints> points_;
  std::size_t count_ = 0;
};

}  // namespace cairn::bullet
