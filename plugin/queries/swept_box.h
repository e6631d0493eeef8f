// SPDX-License-Identifier: Zlib
#pragma once

#include "queries/segment.h"

namespace cairn::bullet {

/// A box that keeps its axes while its centre moves along a segment, in a tree's frame and unit.
///
///     const SweptBox box = sweptBox(shape, callback, margin);
///     const float at = box.entryOf(lower, upper, end);
class SweptBox {
 public:
  /// `path` is that of the box's centre; `halfExtent` includes all growth of the box.
  SweptBox(const Segment& path, const Vec3& halfExtent);

  const Segment& path() const { return path_; }
  /// Where the box can first meet each sphere of a family; spheres count as their boxes. The mask omits spheres that it
  /// does not meet before `end`. Cost: one family.
  Entries entriesOf(const Family& family, std::uint32_t livingLanes, float end) const;
  /// The first place where the box can meet the box [lower, upper]; infinity if it does not meet it before `end`.
  float entryOf(const Vec3& lower, const Vec3& upper, float end) const;

 private:
  Segment path_;
  Vec3 half_, inverse_;
};

}  // namespace cairn::bullet
