// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// The spheres of a solid, in its frame.
struct SolidCover {
  std::vector<Ball> balls;
  std::vector<double> errors;                 ///< of each ball; as `RobotPart` has them
  double sticksOut = 0, leavesOut = 0;        ///< as `RobotPart` has them
  bool covered = false, coversNamed = false;  ///< likewise
};

/// What is wanted of the spheres of a solid: so many, or the fewest that keep an error.
struct CoverWish {
  std::optional<std::uint32_t> spheres = {};
  double maxError = std::numeric_limits<double>::infinity();  ///< metres, of what `errorOf` measures
  Objective objective = Objective::outer;
  std::uint64_t seed = 1;
  bool quick = false;  ///< spend little on the search
};

/// Covers a solid. Precondition: an error wished for is larger than the solid's `offOriginal`.
Result<SolidCover> coverSolid(const RobotSolid& solid, const CoverWish& wish, const ProgressCallback& progress);

/// What placing the spheres in a part may add to their error, metres.
double placingError(const RobotPart& part, const RobotSolid& solid, const CollisionShape& shape);

/// Puts a solid's spheres into a part: mirrored and moved into the link's frame.
void placeCover(const SolidCover& cover, Objective objective, const CollisionShape& shape, RobotPart& part);

/// True for objectives whose spheres cover.
bool isCovering(Objective objective);
/// The error that an objective minimises, metres.
double errorOf(const SolidCover& cover, Objective objective);

}  // namespace cairn::builder
