// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "balls/depth_field.h"
#include "balls/point_set.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// Memory of a `StandOff` for its neighbourhood. Later `StandOff` objects can use the same memory, which saves most
/// allocations.
struct StandOffMemory {
  PointSet farPoints;
  std::vector<double> farDistances;  // from the centre
  std::vector<std::uint32_t> kept;   // scratch of `keepFar`
  std::vector<DepthField::Part> parts;
};

/// The stand-off max |p - c| - s(c) of the smallest ball around a centre c that holds some points. The descent asks for
/// it many times close to one centre. There only the farthest points and the nearest parts of the surface can decide
/// the value. The class keeps these and skips the others. Its results have the same bits as a search through all. Mesh
/// frame and unit. Not thread-safe.
///
///     StandOff standOff(points, field, memory);
///     const StandOff::Value start = standOff.at(center, field.depth(center));
///     const StandOff::Value next = standOff.near(start, step, center + step * direction);
class StandOff {
 public:
  /// Keeps references. Precondition: `points` not empty.
  StandOff(const PointSet& points, const DepthField& solid, StandOffMemory& memory)
      : points_(points), solid_(solid), memory_(memory) {}

  struct Value {
    Ball ball;
    Vec3d gradient;  ///< one subgradient of the stand-off
  };
  /// Cost: one distance query and one pass over the points. Precondition: `depth` is the depth of `center`.
  Value at(const Vec3d& center, double depth) const;

  /// Returns the value at `center`. Preconditions: `around` is an earlier value, `center` lies within `reach` of its
  /// centre, and `reach` > 0. The first call for one `around` costs about as much as `at`. Later calls typically cost
  /// almost nothing.
  Value near(const Value& around, double reach, const Vec3d& center);

 private:
  void gather(const Value& around, double reach);
  void narrow(const Value& around, double reach);
  /// Keeps the points that can be farthest within `reach`. `farDistances` belongs to `points`.
  void keepFar(const PointSet& points, double reach);
  void gatherParts(double depth, double reach);

  const PointSet& points_;
  const DepthField& solid_;
  StandOffMemory& memory_;
  Vec3d around_;        // the centre of the last `near`
  bool known_ = false;  // whether `near` was called before
  double reach_ = 0;    // kept points and parts are valid for centres within this distance; 0: nothing is kept
  bool partsKept_ = false;
  double radius_ = 0;   // of the ball around `around_`
  double decided_ = 0;  // distance of the farthest part that decides the depth at `around_`, with a margin for rounding
};

}  // namespace cairn::builder
