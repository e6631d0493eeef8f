// SPDX-License-Identifier: Zlib
#include "triangles/triangle_touch.h"

namespace cairn::bullet {

namespace {
// Cosine of the 18 degrees off a face's normal within which a node near the face's border still lies over the face.
constexpr float kOverCosine = 0.951056516F;
}  // namespace

bool TriangleTouch::isOver() const {
  return dot(face, line) > kOverCosine;
}

TriangleTouch touchOf(const PlacedTree& tree, const Triangle& triangle, const NodePair& pair) {
  const Vec3 center = tree.sphere(pair.a).center;
  const TrianglePoint nearest = nearestOnTriangle(triangle, center);
  const Vec3 out = center - nearest.point, winding = triangle.normal();
  TriangleTouch touch{pair, nearest.point, {}, dot(winding, out) < 0 ? -winding : winding, length(out), nearest.onFace};
  const Vec3 line = unitVector(out);
  touch.line = touch.onFace || lengthSq(line) == 0 ? touch.face : line;
  return touch;
}

}  // namespace cairn::bullet
