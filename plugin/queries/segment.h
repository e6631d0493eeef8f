// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/family.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The path of a query through a tree, in the tree's frame and unit.
///
///     const Segment segment(from, to, slack);
///     if (segment.isSane()) entries = entriesOf(segment, family, livingLanes, segment.placeOf(1));
///
/// Places on it are floats: distances from the point of its line nearest to the frame's origin. Near the tree they are
/// as precise as the tree itself, however far away the query begins.
class Segment {
 public:
  /// `slack`: grows all nodes by this much. A path without length, or a non-finite one, meets nothing.
  Segment(const Vec3d& from, const Vec3d& to, double slack);

  /// Whether the path is finite and has a length.
  bool isSane() const { return isSane_; }
  const Vec3& origin() const { return origin_; }
  const Vec3& direction() const { return direction_; }
  float slack() const { return slack_; }
  float begin() const { return begin_; }
  /// The place of a fraction of the path, rounded away from its start.
  float placeOf(double fraction) const { return static_cast<float>(start_ + fraction * length_) + slack_; }
  /// The fraction of the path at a place.
  double fractionOf(float place) const { return (static_cast<double>(place) - start_) / length_; }

 private:
  double start_ = 0, length_ = 0;
  Vec3 origin_, direction_;
  float begin_ = 0, slack_ = 0;
  bool isSane_ = false;
};

/// Where a query enters each sphere of a family. The mask `lanes` omits spheres that it does not meet before `end`.
struct Entries {
  float at[kFamilyWidth];
  std::uint32_t lanes = 0;
};

/// For a point that moves along `segment`, and spheres grown by its slack. Cost: one family.
Entries entriesOf(const Segment& segment, const Family& family, std::uint32_t livingLanes, float end);

}  // namespace cairn::bullet
