// SPDX-License-Identifier: Zlib
#include "counterparts/triangle.h"

#include <algorithm>

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

}  // namespace

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
