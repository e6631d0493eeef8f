// SPDX-License-Identifier: Zlib
#include "placement/triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::bullet {

namespace {

Vec3 nearestOnSegment(const Vec3& from, const Vec3& to, const Vec3& p) {
  const Vec3 along = to - from;
  const float alongSq = lengthSq(along);
  const float t = alongSq > 0 ? std::clamp(dot(p - from, along) / alongSq, 0.0F, 1.0F) : 0.0F;
  return from + along * t;
}

Vec3 nearestOnBorder(const Triangle& t, const Vec3& p) {
  Vec3 best = nearestOnSegment(t.a, t.b, p);
  for (const Vec3& q : {nearestOnSegment(t.b, t.c, p), nearestOnSegment(t.c, t.a, p)})
    if (lengthSq(p - q) < lengthSq(p - best)) best = q;
  return best;
}

// Nearest points of the lines, clamped to the segments one after the other.
NearestPoints nearestOfSegments(const Vec3& p, const Vec3& toP, const Vec3& q, const Vec3& toQ) {
  const Vec3 u = toP - p, v = toQ - q, w = p - q;
  const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const float area = uu * vv - uv * uv;
  float s = area > 0 ? std::clamp((uv * vw - vv * uw) / area, 0.0F, 1.0F) : 0.0F;
  const float t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0F, 1.0F) : 0.0F;
  s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0F, 1.0F) : 0.0F;
  return {p + u * s, q + v * t};
}

}  // namespace

// For a triangle that is a point, the longest edge has no length, and the result is the z axis.
Vec3 anyNormalOf(const Triangle& t) {
  const Vec3 normal = t.normal();
  if (lengthSq(normal) > 0) return normal;
  const Vec3 longest = std::max({t.b - t.a, t.c - t.b, t.a - t.c},
                                [](const Vec3& u, const Vec3& v) { return lengthSq(u) < lengthSq(v); });
  const bool isUpright = std::abs(longest.z) >= std::abs(longest.x) && std::abs(longest.z) >= std::abs(longest.y);
  const Vec3 across = unitVector(cross(longest, isUpright ? Vec3(1, 0, 0) : Vec3(0, 0, 1)));
  return lengthSq(across) > 0 ? across : Vec3(0, 0, 1);
}

NearestPoints nearestOfTriangles(const Triangle& first, const Triangle& second) {
  const std::array<Vec3, 3> p{first.a, first.b, first.c}, q{second.a, second.b, second.c};
  NearestPoints best{p[0], q[0]};
  const auto offer = [&](const NearestPoints& n) {
    if (lengthSq(n.onFirst - n.onSecond) < lengthSq(best.onFirst - best.onSecond)) best = n;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    offer({p[i], nearestOnTriangle(second, p[i]).point});
    offer({nearestOnTriangle(first, q[i]).point, q[i]});
    for (std::size_t j = 0; j < 3; ++j) offer(nearestOfSegments(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]));
  }
  return best;
}

TrianglePoint nearestOnTriangle(const Triangle& t, const Vec3& p) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const float bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const float pb = dot(ap, ab), pc = dot(ap, ac);
  const float area = bb * cc - bc * bc;
  const float v = cc * pb - bc * pc;
  const float w = bb * pc - bc * pb;
  const bool inside = area > 0 && v > 0 && w > 0 && v + w < area;
  if (!inside) return {nearestOnBorder(t, p), false};
  return {t.a + ab * (v / area) + ac * (w / area), true};
}

}  // namespace cairn::bullet
