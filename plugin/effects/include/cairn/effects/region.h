// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btScalar.h>

#include <vector>

#include "cairn/core/export.h"

namespace cairn::effects {

/// A part of the map: everywhere, or the inside of a polygon in x and y (world frame, m; z is up).
class CAIRN_EFFECTS_EXPORT Region {
 public:
  /// A corner.
  struct Point {
    btScalar x, y;  ///< world frame, m
  };

  /// Everywhere.
  Region() = default;
  /// The inside by the even-odd rule; the last corner is joined to the first. Precondition: three corners or more.
  explicit Region(std::vector<Point> corners);

  /// Whether there is no border.
  bool isEverywhere() const { return corners_.empty(); }
  /// Linear in the corners, but for what is outside the polygon's box.
  bool contains(btScalar x, btScalar y) const;

 private:
  std::vector<Point> corners_;
  Point lower_{0, 0}, upper_{0, 0};
};

}  // namespace cairn::effects
