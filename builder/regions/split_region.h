// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "balls/sphere_set.h"
#include "cairn/builder/build.h"
#include "medial/hubbard_medial.h"
#include "regions/region.h"
#include "spheres/hubbard.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// The settings that all splits of one build share.
struct SplitSettings {
  Method method = Method::combined;
  std::size_t branching = 8;
  std::uint64_t seed = 1;
  double negligible = 0;                   ///< stand-off that is not worth a split; mesh unit, > 0
  const HubbardMedial* hubbard = nullptr;  ///< the solid's; for that method only
  Optimiser optimiser = Optimiser::cairn;
  std::optional<Balance> balance{};
  SurfaceDivision division = SurfaceDivision::standOff;
  /// Called during long splits. Once it returns false, splits end undivided and must not be used.
  KeepGoing keepGoing = [] { return true; };
  /// True when the solid has no relevant concavity, so that it equals its closing.
  bool convex = false;
};

/// Returns the region of a whole mesh: its triangles cut into about `samples` pieces, and the smallest ball that holds
/// them.
Region rootRegion(const SignedDistance& solid, std::size_t samples);

/// The division of a region, kept so that it can be changed later. For cubes and Hubbard's groups only `children` is
/// filled.
struct Split {
  Pieces pieces;             ///< of the region, small enough to fit spheres to
  PointSet points;           ///< the points that the spheres were fitted to
  SphereSet balls;           ///< one for each child; depths are those of the field they were fitted in
  std::vector<double> bias;  ///< by ball, see `divide`
  double standOff = 0;       ///< stand-off at which the balls cover the region's pieces, seams included
  /// At most `branching` children; none when the region fits its ball so well that children are pointless.
  std::vector<Region> children;
  double allowed = std::numeric_limits<double>::infinity();  ///< upper limit of the children's worst error

  /// Returns the worst error of the children, 0 without any.
  double worst() const;
};

/// Divides a region among at most `branching` balls (thesis Alg. 8 with the chosen reduction). For `swapRounds` see
/// `optimiseBySwaps`. A pure function of its arguments.
Split splitRegion(const Region& region, const SignedDistance& solid, const SplitSettings& settings, int swapRounds);

/// Returns a better division of the same region, or the given one. Fits the balls of `split` anew against the closing
/// of the solid at about their stand-off (`ClosedDepth`). So the balls may fill narrow concavities. For builds
/// optimised by `cairn`. A pure function.
Split refineSplit(const Split& split, const Region& region, const SignedDistance& solid, const SplitSettings& settings,
                  int swapRounds);

/// A division with all children's errors below some goal; `refined` is true when `refineSplit` was needed.
struct SplitBelow {
  Split split;
  bool refined = false;
};

/// Returns a division with all errors below `goal`, or nothing. It starts from the balls of `like`, the division of a
/// similar region, or from `splitRegion` without swaps when `like` is empty. If the goal is missed, `refineSplit` is
/// tried. An attempt ends as soon as one child fails. For builds optimised by `cairn`. A pure function. Precondition:
/// `goal` is above `negligible`.
std::optional<SplitBelow> splitBelow(const Region& region, const Split& like, const SignedDistance& solid,
                                     const SplitSettings& settings, int swapRounds, double goal);

/// Returns the balls with their depths in `field`.
SphereSet seenBy(const DepthField& field, SphereSet balls);

/// Divides the region of `split` among `start`, after these are optimised as at most `settings.branching` balls in
/// `field`. Seams are optimised too, whatever the settings' optimiser. Precondition: `start` is not empty. A pure
/// function.
Split splitAmong(const Split& split, SphereSet start, const DepthField& field, const SignedDistance& solid,
                 const SplitSettings& settings);

/// Divides the region of `split` among `balls` as they are, and fits a ball to each part (thesis Alg. 8). Precondition:
/// `balls` is not empty. A pure function.
Split splitAsTheyAre(const Split& split, SphereSet balls, const SignedDistance& solid, const SplitSettings& settings);

/// Divides the split's pieces anew among its balls, with other seams, and refits the balls of changed parts. Returns
/// nothing when the error of one of them is above `ofInterest`.
std::optional<Split> redivide(const Split& split, std::vector<double> bias, double standOff, double ofInterest,
                              const SignedDistance& solid, const SplitSettings& settings);

}  // namespace cairn::builder
