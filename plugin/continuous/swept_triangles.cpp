// SPDX-License-Identifier: Zlib
#include "continuous/swept_triangles.h"

#include <algorithm>
#include <cmath>

#include "continuous/entry_into_box.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

void SweptTriangles::take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) {
  soup_.gather(static_cast<const btConcaveShape&>(shape), lower, upper);
  elements_.clear();
  for (const TriangleSoup::Source& source : soup_.triangles()) {
    const Triangle t{toVec3(source.corners[0]), toVec3(source.corners[1]), toVec3(source.corners[2])};
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min({t.a[axis], t.b[axis], t.c[axis]});
      high[axis] = std::max({t.a[axis], t.b[axis], t.c[axis]});
    }
    elements_.push_back({t, t.normal(), low, high});
  }
}

float SweptTriangles::radius(std::uint32_t element) const {
  return 0.5F * length(elements_[element].upper - elements_[element].lower);
}

// Both its box and the slab around its plane have to be entered.
std::optional<float> SweptTriangles::entry(const Sphere& ball, std::uint32_t element, const Vec3& way) const {
  const Element& e = elements_[element];
  const float height = dot(e.normal, ball.center - e.triangle.a), closing = -dot(e.normal, way);
  float intoSlab = 0;
  if (std::abs(height) > ball.radius) {
    const float ahead = height > 0 ? height - ball.radius : height + ball.radius;
    if (ahead * closing <= 0 || std::abs(closing) < std::abs(ahead)) return std::nullopt;
    intoSlab = ahead / closing;
  }
  const Vec3 grow(ball.radius, ball.radius, ball.radius);
  const std::optional<float> intoBox = entryIntoBox(e.lower - grow, e.upper + grow, ball.center, way);
  if (!intoBox) return std::nullopt;
  return std::max(*intoBox, intoSlab);
}

Vec3 SweptTriangles::support(std::uint32_t element, const Vec3& direction) const {
  const Triangle& t = elements_[element].triangle;
  const float a = dot(direction, t.a), b = dot(direction, t.b), c = dot(direction, t.c);
  if (a >= b && a >= c) return t.a;
  return b >= c ? t.b : t.c;
}

void SweptTriangles::appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) {
  const Element& e = elements_[element];
  const Vec3 line = center - nearestOnTriangle(e.triangle, center).point;
  if (lengthSq(line) > 0) normals.add(normalized(line), false);
  normals.add(e.normal, true);
  normals.add(-e.normal, true);
}

void SweptTriangles::name(std::uint32_t element, ContactId& id) const {
  id.otherPart = soup_.triangles()[element].part;
  id.otherIndex = soup_.triangles()[element].index;
}

}  // namespace cairn::bullet
