// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "balls/depth_field.h"
#include "balls/point_set.h"
#include "cairn/builder/ball.h"

namespace cairn::builder {

/// What a `StandOff` keeps near its centre. One after the other can use the same, which saves most of their
/// allocations.
struct StandOffMemory {
  PointSet farPoints;
  std::vector<double> farDistances;  // from the centre
  std::vector<std::uint32_t> kept;   // for `keepFar` alone
  std::vector<DepthField::Part> parts;
};

/// The stand-off max |p - c| - s(c) of the ball around a centre c that just holds some points, as the descent needs it:
/// many times close to one centre. Then only points nearly as far as the farthest and parts of the surface nearly as
/// near as the nearest can decide, so those are kept and the others not looked at. The bits are those of looking at
/// all. Mesh frame and unit. For one thread.
class StandOff {
 public:
  /// Keeps references. Precondition: `points` not empty.
  StandOff(const PointSet& points, const DepthField& solid, StandOffMemory& memory)
      : points_(points), solid_(solid), memory_(memory) {}

  struct Value {
    Ball ball;
    Vec3d gradient;  ///< one subgradient of the stand-off
  };
  /// One distance query and one pass over the points. Precondition: `depth` is that of `center`.
  Value at(const Vec3d& center, double depth) const;

  /// The value at `center`, of which it is known that it lies within `reach` of the centre of `around`, itself an
  /// earlier value. The first call for one `around` costs about what `at` does, the later ones next to nothing,
  /// typically. Precondition: `reach` > 0.
  Value near(const Value& around, double reach, const Vec3d& center);

 private:
  void gather(const Value& around, double reach);
  void narrow(const Value& around, double reach);
  /// Keeps those of `points`, which `farDistances` belongs to, that can be farthest within `reach`.
  void keepFar(const PointSet& points, double reach);
  void gatherParts(double depth, double reach);

  const PointSet& points_;
  const DepthField& solid_;
  StandOffMemory& memory_;
  Vec3d around_;        // the centre of the last `near`
  bool known_ = false;  // whether there was one
  double reach_ = 0;    // what is kept holds for centres within this; 0 when nothing is kept
  bool partsKept_ = false;
  double radius_ = 0;   // of the ball around `around_`
  double decided_ = 0;  // farthest part that decides the depth at `around_` itself, with room for rounding
};

}  // namespace cairn::builder
