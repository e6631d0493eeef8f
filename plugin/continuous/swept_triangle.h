// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/family.h"
#include "continuous/separating_normals.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// A triangle that a moving ball may meet.
///
///     if (const auto at = SweptTriangle(triangle).entry(ball, displacement)) ...;
struct SweptTriangle {
  Triangle triangle;
  Vec3 normal;  ///< zero if the triangle is degenerate
  Vec3 lower, upper;

  explicit SweptTriangle(const Triangle& t);

  /// See `SweptTarget::entry` and `SweptTarget::appendNormals`.
  std::optional<float> entry(const Sphere& ball, const Vec3& displacement) const;
  void appendNormals(const Vec3& center, SeparatingNormals& normals) const;
};

}  // namespace cairn::bullet
