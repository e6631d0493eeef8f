// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdint>
#include <vector>

#include "cairn/effects/ground_height.h"
#include "cairn/effects/single_trees.h"

namespace cairn::effects {

/// Stems in a uniform grid over x and y, about one to a cell, each in the cell of its axis.
class StemGrid {
 public:
  /// `height`: of stems without one of their own.
  StemGrid(const std::vector<SingleTrees::Stem>& stems, const GroundHeight& ground, btScalar height);

  std::size_t size() const { return stems_.size(); }
  btScalar diameter(std::uint32_t stem) const { return stems_[stem].diameter; }
  /// A point of the stem's axis, at height 0.
  btVector3 axis(std::uint32_t stem) const { return {stems_[stem].x, stems_[stem].y, 0}; }
  /// Appends the stems that a ball touches on its way from `from` to `to`, cell by cell. Linear in the stems of the
  /// cells around the way's box.
  void touchedBy(const btVector3& from, const btVector3& to, btScalar radius,
                 std::vector<std::uint32_t>& touched) const;

 private:
  struct Standing {
    btScalar x, y, diameter, top;
  };
  struct Cells {
    std::size_t first, end;  // along one axis
  };

  static bool touches(const Standing& stem, const btVector3& from, const btVector3& to, btScalar radius);
  void sortIntoCells();
  Cells cellsBetween(btScalar lower, btScalar upper, btScalar origin, std::size_t count) const;

  std::vector<Standing> stems_;       // cell by cell
  std::vector<std::size_t> firstOf_;  // by cell, row by row; one more at the end
  btScalar lowerX_ = 0, lowerY_ = 0, upperX_ = 0, upperY_ = 0, width_ = 1, greatestRadius_ = 0;
  std::size_t columns_ = 0, rows_ = 0;
};

}  // namespace cairn::effects
