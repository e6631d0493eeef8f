// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/family.h"
#include "cairn/core/vec3.h"
#include "volumes/swept_ball.h"

namespace cairn::bench {

/// A ball alone, as small as it can be.
struct PlainBall {
  Vec3d center;
  double radius = 0;
};

/// Rotation and translation of one body into the other's frame.
struct RigidMove {
  Mat3d rotation;
  Vec3d translation;

  Vec3d operator*(const Vec3d& p) const { return rotation * p + translation; }
  PlainBall operator*(const PlainBall& v) const { return {*this * v.center, v.radius}; }
  SweptBall operator*(const SweptBall& v) const {
    SweptBall moved = v;
    moved.center = *this * v.center;
    for (int i = 0; i < v.dimensions(); ++i) moved.axes[i] = rotation * v.axes[i];
    return moved;
  }
};

/// The slack of `mayMeet` for bodies that lie within `lengths` of the origin of the frame they meet in: that of trees.
inline double overlapSlack(double lengths) {
  return lengths * double(kOverlapSlack);
}

/// Whether two volumes may have a point in common. Never false for two that are `slack` apart or nearer. Exact up to
/// `slack` for balls and capsules; true for some pairs of slabs and boxes that are a little apart.
inline bool mayMeet(const PlainBall& a, const PlainBall& b, double slack) {
  const double reach = a.radius + b.radius + slack;
  return lengthSq(a.center - b.center) <= reach * reach;
}

namespace detail {

/// Square of the distance between two segments. Those that are parallel up to a millionth count as parallel, which
/// errs by at most a millionth of the lengths: less than `overlapSlack`.
inline double segmentDistanceSq(const SweptBall& a, const SweptBall& b) {
  const Vec3d between = b.center - a.center;
  const double cosine = dot(a.axes[0], b.axes[0]), alongA = dot(between, a.axes[0]), alongB = dot(between, b.axes[0]);
  const double sineSq = 1 - cosine * cosine;
  double s = sineSq > 1e-12 ? std::clamp((alongA - cosine * alongB) / sineSq, -a.half[0], a.half[0]) : 0;
  const double t = std::clamp(cosine * s - alongB, -b.half[0], b.half[0]);
  s = std::clamp(cosine * t + alongA, -a.half[0], a.half[0]);
  return lengthSq(between + b.axes[0] * t - a.axes[0] * s);
}

/// Whether the planes across a direction of any length hold the cores farther apart than `reach`.
inline bool separates(const SweptBall& a, const SweptBall& b, const Vec3d& direction, double reach) {
  double gap = std::abs(dot(b.center - a.center, direction));
  for (int i = 0; i < a.dimensions(); ++i) gap -= a.half[i] * std::abs(dot(a.axes[i], direction));
  for (int i = 0; i < b.dimensions(); ++i) gap -= b.half[i] * std::abs(dot(b.axes[i], direction));
  return gap > 0 && gap * gap > reach * reach * lengthSq(direction);
}

/// For cores of which one at least is a rectangle or a box. Answers true when points of the cores are near enough,
/// false when a direction separates them; true when neither is found.
inline bool boxesMayMeet(const SweptBall& a, const SweptBall& b, double reach) {
  constexpr int kProjections = 3;
  Vec3d p = a.nearestOnCore(b.center);
  for (int round = 0; round < kProjections; ++round) {
    const Vec3d q = b.nearestOnCore(p);
    p = a.nearestOnCore(q);
    if (lengthSq(q - p) <= reach * reach) return true;
    if (separates(a, b, q - p, reach)) return false;
  }
  for (const SweptBall* v : {&a, &b}) {
    if (v->dimensions() != 2) continue;  // a box's normals are its axes, below
    if (separates(a, b, cross(v->axes[0], v->axes[1]), reach)) return false;
  }
  for (int i = 0; i < a.dimensions(); ++i)
    for (int j = 0; j < b.dimensions(); ++j)
      if (separates(a, b, cross(a.axes[i], b.axes[j]), reach)) return false;
  for (const SweptBall* v : {&a, &b})
    for (int i = 0; i < v->dimensions(); ++i)
      if (separates(a, b, v->axes[i], reach)) return false;
  return true;
}

}  // namespace detail

inline bool mayMeet(const SweptBall& a, const SweptBall& b, double slack) {
  const double reach = a.radius + b.radius + slack;
  if (a.kind == VolumeKind::ball) return lengthSq(a.center - b.nearestOnCore(a.center)) <= reach * reach;
  if (b.kind == VolumeKind::ball) return lengthSq(b.center - a.nearestOnCore(b.center)) <= reach * reach;
  if (a.kind == VolumeKind::capsule && b.kind == VolumeKind::capsule)
    return detail::segmentDistanceSq(a, b) <= reach * reach;
  return detail::boxesMayMeet(a, b, reach);
}

}  // namespace cairn::bench
