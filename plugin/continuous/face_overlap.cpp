// SPDX-License-Identifier: Zlib
#include "continuous/face_overlap.h"

#include <algorithm>
#include <cmath>

#include "contacts/cut_face.h"

namespace cairn::bullet {

namespace {

using Common = CutFace<kMaxFaceCorners>;

// Fraction of the first face's size within which a point beside it still lies over it. Otherwise rounding would lose
// the point in which two edges cross.
constexpr float kOverlapSeam = 1e-3F;

Vec3 beside(const Vec3& normal, const Vec3& v) {
  return v - normal * dot(normal, v);
}

Vec3 middleOf(std::span<const Vec3> points) {
  Vec3 sum{};
  for (const Vec3& p : points) sum += p;
  return sum * (1 / static_cast<float>(points.size()));
}

// The nearest point on a convex face's border, seen along the normal.
Vec3 nearestOnBorder(const Vec3& normal, std::span<const Vec3> face, const Vec3& point) {
  Vec3 nearest = face.front();
  float leastSq = lengthSq(beside(normal, nearest - point));
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 &from = face[i], edge = face[(i + 1) % face.size()] - from, along = beside(normal, edge);
    if (lengthSq(along) == 0) continue;
    const Vec3 on = from + edge * std::clamp(dot(point - from, along) / lengthSq(along), 0.0F, 1.0F);
    const float besideSq = lengthSq(beside(normal, on - point));
    if (besideSq >= leastSq) continue;
    leastSq = besideSq;
    nearest = on;
  }
  return nearest;
}

// The part of the second face that lies over the first.
Common commonOf(const Vec3& normal, std::span<const Vec3> first, std::span<const Vec3> second, const Vec3& middle) {
  float reachSq = 0;
  for (const Vec3& corner : first) reachSq = std::max(reachSq, lengthSq(corner - middle));
  const float seam = kOverlapSeam * std::sqrt(reachSq);
  Common common(second);
  const auto cut = [&](const Vec3& inwards, const Vec3& at) {
    common.cut(inwards, dot(inwards, at) - seam * length(inwards));
  };
  if (first.size() == 2) {
    const Vec3 along = first[1] - first[0], across = cross(normal, along);
    cut(along, first[0]);
    cut(-along, first[1]);
    cut(across, first[0]);
    cut(-across, first[0]);
    return common;
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    // Each cut keeps the side of the middle, whichever way round the corners come.
    const Vec3 side = cross(normal, first[(i + 1) % first.size()] - first[i]);
    cut(dot(side, middle - first[i]) < 0 ? -side : side, first[i]);
  }
  return common;
}

}  // namespace

void FaceOverlap::find(const Vec3& normal, std::span<const Vec3> first, std::span<const Vec3> second) {
  count_ = 0;
  const Vec3 middle = middleOf(first);
  if (first.size() > 1) takeSome(commonOf(normal, first, second, middle).points());
  if (count_ == 0) points_[count_++] = nearestOnBorder(normal, second, middle);
}

void FaceOverlap::takeSome(std::span<const Vec3> common) {
  const std::size_t count = std::min(common.size(), kMax);
  for (std::size_t i = 0; i < count; ++i) points_[count_++] = common[i * common.size() / count];
}

}  // namespace cairn::bullet
