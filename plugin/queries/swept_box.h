// SPDX-License-Identifier: Zlib
#pragma once

#include "queries/segment.h"

namespace cairn::bullet {

/// A box that keeps its axes while its centre moves along a segment, in a tree's frame and unit.
class SweptBox {
 public:
  /// The path is that of the box's centre; `halfExtent` includes whatever the box is to be grown by.
  SweptBox(const Segment& path, const Vec3& halfExtent);

  const Segment& path() const { return path_; }
  /// Where the box can first meet each sphere of a family; whatever it does not meet before `end` is not in the mask.
  /// Balls count as their boxes. Cost: one family.
  Entries entriesOf(const Family& family, std::uint32_t livingLanes, float end) const;
  /// The place where the box can first meet the box [lower, upper], or more than `end`.
  float entryOf(const Vec3& lower, const Vec3& upper, float end) const;

 private:
  Segment path_;
  Vec3 half_, inverse_;
};

}  // namespace cairn::bullet
