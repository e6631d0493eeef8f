// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "cairn/core/family.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// The way of a query through a tree, in the tree's frame and unit.
///
/// Places on it are told in float by their distance from the point of its line that is nearest to the frame's origin:
/// near the tree they are then as fine as the tree itself, however far away the query begins.
class Segment {
 public:
  /// `slack`: by how much nodes are to be taken as larger. A way of no length, or not finite, meets nothing.
  Segment(const Vec3d& from, const Vec3d& to, double slack);

  /// Whether there is a way at all.
  bool isSane() const { return isSane_; }
  const Vec3& origin() const { return origin_; }
  const Vec3& direction() const { return direction_; }
  float slack() const { return slack_; }
  float begin() const { return begin_; }
  /// The place of a fraction of the way, rounded away from its begin.
  float placeOf(double fraction) const { return static_cast<float>(start_ + fraction * length_) + slack_; }
  /// The fraction at which a place lies.
  double fractionOf(float place) const { return (static_cast<double>(place) - start_) / length_; }

 private:
  double start_ = 0, length_ = 0;
  Vec3 origin_, direction_;
  float begin_ = 0, slack_ = 0;
  bool isSane_ = false;
};

/// Where a query enters each sphere of a family; whatever it does not meet before `end` is not in the mask.
struct Entries {
  float at[kFamilyWidth];
  std::uint32_t lanes = 0;
};

/// Of a point that moves along `segment`, for spheres grown by its slack. Cost: one family.
Entries entriesOf(const Segment& segment, const Family& family, std::uint32_t livingLanes, float end);

}  // namespace cairn::bullet
