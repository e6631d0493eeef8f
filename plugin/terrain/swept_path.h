// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cmath>

#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// A range of fractions of a path; empty where from > to.
struct PathPart {
  double from = 0, to = 1;

  bool isEmpty() const { return !(from <= to); }
  PathPart cutTo(const PathPart& other) const { return {std::max(from, other.from), std::min(to, other.to)}; }
};

/// A box that keeps its axes while its centre moves from one point to another; a ray where `half` is zero. In the
/// terrain's frame.
///
///     const PathPart part = path.within(axis, lower, upper);
///     if (!part.isEmpty()) use(path.least(2, part), path.greatest(2, part));
struct SweptPath {
  Vec3d from, path, half;

  double at(int axis, double fraction) const { return from[axis] + fraction * path[axis]; }
  /// The fractions at which it shares a coordinate with [lower, upper].
  PathPart within(int axis, double lower, double upper) const {
    const double toLower = lower - half[axis] - from[axis], toUpper = upper + half[axis] - from[axis];
    if (path[axis] == 0) return toLower <= 0 && toUpper >= 0 ? PathPart{} : PathPart{1, 0};
    const double a = toLower / path[axis], b = toUpper / path[axis];
    return {std::max(std::min(a, b), 0.0), std::min(std::max(a, b), 1.0)};
  }
  /// The least and the greatest coordinate it has during a part of the path.
  double least(int axis, const PathPart& part) const {
    return std::min(at(axis, part.from), at(axis, part.to)) - half[axis];
  }
  double greatest(int axis, const PathPart& part) const {
    return std::max(at(axis, part.from), at(axis, part.to)) + half[axis];
  }
};

}  // namespace cairn::bullet
