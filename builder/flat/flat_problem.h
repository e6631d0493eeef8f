// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "balls/sphere_set.h"
#include "cairn/builder/progress.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// A whole surface to be covered by one flat set of balls.
struct FlatProblem {
  const SignedDistance& solid;
  std::size_t count = 8;  ///< balls, exactly
  std::uint64_t seed = 1;
  double negligible = 0;  ///< stand-off not worth lowering, > 0
  bool quick = false;     ///< a rough answer in a fraction of the time
  const KeepGoing& keepGoing;
};

/// Points of the whole surface: sets are fitted to `points`; limits hold for `dense`, several times as many.
struct FlatPoints {
  PointSet points, dense;
};

/// Enough points for so many balls. Linear in them.
FlatPoints flatPointsOf(const TriangleMesh& mesh, std::size_t count);

}  // namespace cairn::builder
