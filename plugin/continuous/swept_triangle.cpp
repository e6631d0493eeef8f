// SPDX-License-Identifier: Zlib
#include "continuous/swept_triangle.h"

#include <algorithm>
#include <cmath>

#include "continuous/entry_into_box.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

SweptTriangle::SweptTriangle(const Triangle& t) : triangle(t), normal(t.normal()) {
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = std::min({t.a[axis], t.b[axis], t.c[axis]});
    upper[axis] = std::max({t.a[axis], t.b[axis], t.c[axis]});
  }
}

// The ball must enter both the triangle's box and the slab around its plane.
std::optional<float> SweptTriangle::entry(const Sphere& ball, const Vec3& displacement) const {
  const float height = dot(normal, ball.center - triangle.a), closing = -dot(normal, displacement);
  float intoSlab = 0;
  if (std::abs(height) > ball.radius) {
    const float ahead = height > 0 ? height - ball.radius : height + ball.radius;
    if (ahead * closing <= 0 || std::abs(closing) < std::abs(ahead)) return std::nullopt;
    intoSlab = ahead / closing;
  }
  const Vec3 grow(ball.radius, ball.radius, ball.radius);
  const std::optional<float> intoBox = entryIntoBox(lower - grow, upper + grow, ball.center, displacement);
  if (!intoBox) return std::nullopt;
  return std::max(*intoBox, intoSlab);
}

void SweptTriangle::appendNormals(const Vec3& center, SeparatingNormals& normals) const {
  const Vec3 line = center - nearestOnTriangle(triangle, center).point;
  if (line != Vec3()) normals.add(unitVector(line), false);
  normals.add(normal, true);
  normals.add(-normal, true);
}

}  // namespace cairn::bullet
