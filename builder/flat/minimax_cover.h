// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "flat/flat_problem.h"

namespace cairn::builder {

/// A flat set and the depths it was fitted in.
struct FlatSet {
  SphereSet balls;      ///< depths as the field sees them; radii as the points need them
  double standOff = 0;  ///< at which they cover all dense points, in that field
  /// The first so many pairs of balls are each other's mirror images, the other balls their own; 0 without a mirror.
  std::size_t pairs = 0;
};

/// Where the depth of a centre is measured from.
enum class DepthOf : std::uint8_t {
  closing,      ///< of the solid's closing at about the stand-off the set ends with: balls may fill narrow concavities
  halfClosing,  ///< at about half of it, for balls that will be shrunk by half
  solid,        ///< of the solid itself
};

/// Lowers the worst stand-off at which exactly-as-good-as-found sets of at most `count` balls cover the surface:
/// optimises every start, goes on with the best in the closing, relocates balls, and fits them to what lies between the
/// points. Returns the best. Deterministic, parallel over starts. Empty when cancelled.
FlatSet minimaxCover(const FlatProblem& problem, const FlatPoints& points, DepthOf depthOf,
                     std::vector<SphereSet> starts);

}  // namespace cairn::builder
