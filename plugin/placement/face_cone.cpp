// SPDX-License-Identifier: Zlib
#include "placement/face_cone.h"

#include <cmath>
#include <cstddef>

namespace cairn::bullet {

namespace {

// Sine of the angle below which faces are parallel, so that their normals span nothing.
constexpr float kMinSine = 0.02F;

bool isNear(const Vec3& face, const Vec3& direction) {
  return dot(face, direction) > 0 && lengthSq(cross(face, direction)) <= kConeSlack * kConeSlack;
}

// Whether the direction is on the arc between two normals, or hardly beside it.
bool isBetween(const Vec3& first, const Vec3& second, const Vec3& direction) {
  const Vec3 edge = cross(first, second);
  const float sineSq = lengthSq(edge);
  if (sineSq < kMinSine * kMinSine) return false;
  const float beside = dot(edge, direction);
  return beside * beside <= kConeSlack * kConeSlack * sineSq && dot(cross(first, direction), edge) >= 0 &&
         dot(cross(direction, second), edge) >= 0;
}

// Whether the direction is inside the spherical triangle of three normals, in either order.
bool isInside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& direction) {
  const float turn = dot(a, cross(b, c));
  if (std::abs(turn) < kMinSine * kMinSine) return false;
  const float sign = turn > 0 ? 1.0F : -1.0F;
  return sign * dot(direction, cross(a, b)) >= 0 && sign * dot(direction, cross(b, c)) >= 0 &&
         sign * dot(direction, cross(c, a)) >= 0;
}

}  // namespace

bool isAmongNormals(std::span<const Vec3> faces, const Vec3& direction) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (isNear(faces[i], direction)) return true;
    for (std::size_t j = i + 1; j < faces.size(); ++j)
      if (isBetween(faces[i], faces[j], direction)) return true;
  }
  return faces.size() == 3 && isInside(faces[0], faces[1], faces[2], direction);
}

}  // namespace cairn::bullet
