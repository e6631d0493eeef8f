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

/// What all splits of one build have in common.
struct SplitSettings {
  Method method = Method::combined;
  std::size_t branching = 8;
  std::uint64_t seed = 1;
  double negligible = 0;                   ///< stand-off not worth splitting for, mesh unit, > 0
  const HubbardMedial* hubbard = nullptr;  ///< of the solid; for that method only
  Optimiser optimiser = Optimiser::cairn;
  std::optional<Balance> balance{};
  /// Asked during splits that take long; once it says no, splits come out undivided and are not to be used.
  KeepGoing keepGoing = [] { return true; };
  /// The solid has no concavity worth closing: its closing is itself.
  bool convex = false;
};

/// The region of a whole mesh: its triangles cut into about `samples` pieces, and the smallest ball that holds them.
Region rootRegion(const SignedDistance& solid, std::size_t samples);

/// How a region was divided, kept so that the division can be changed later. For cubes and Hubbard's groups only
/// `children` is filled.
struct Split {
  Pieces pieces;             ///< of the region, cut finely enough to fit spheres to
  PointSet points;           ///< what the spheres were fitted to
  SphereSet balls;           ///< one for each child; depths as the field they were fitted with sees them
  std::vector<double> bias;  ///< by ball, see `divide`
  double standOff = 0;       ///< at which the balls cover the region's pieces, seams included
  /// At most `branching`; none when the region fits its ball so well that they are pointless.
  std::vector<Region> children;
  double allowed = std::numeric_limits<double>::infinity();  ///< most the children's worst error may become

  /// Worst error of the children, 0 without any.
  double worst() const;
};

/// Divides a region among at most `branching` balls (thesis Alg. 8 with the chosen reduction). `swapRounds`: see
/// `optimiseBySwaps`. A pure function of its arguments.
Split splitRegion(const Region& region, const SignedDistance& solid, const SplitSettings& settings, int swapRounds);

/// A better division of the same region, or the same one: fits the balls of `split` anew against the closing of the
/// solid at about their stand-off (`ClosedDepth`), which lets them fill narrow concavities. For builds
/// optimised by `cairn`. A pure function.
Split refineSplit(const Split& split, const Region& region, const SignedDistance& solid, const SplitSettings& settings,
                  int swapRounds);

/// A division all of whose children's errors are below some goal, and whether it took `refineSplit` to get there.
struct SplitBelow {
  Split split;
  bool refined = false;
};

/// A division below `goal`: one that starts from the balls of `like`, the division of much the same region, or
/// `splitRegion` without swaps when `like` is empty; else `refineSplit` of it; nothing when neither gets there, which
/// is known as soon as one child fails. For builds optimised by `cairn`. A pure function. Precondition: `goal` above
/// what is negligible.
std::optional<SplitBelow> splitBelow(const Region& region, const Split& like, const SignedDistance& solid,
                                     const SplitSettings& settings, int swapRounds, double goal);

/// The balls with their depths as `field` sees them.
SphereSet seenBy(const DepthField& field, SphereSet balls);

/// The region of `split` divided among `start` (not empty), once these are optimised as at most `settings.branching`
/// balls in `field`: for the seams too, whatever the settings' optimiser. A pure function.
Split splitAmong(const Split& split, SphereSet start, const DepthField& field, const SignedDistance& solid,
                 const SplitSettings& settings);

/// Divides the split's pieces anew among its balls, with other seams, and refits the balls of parts that changed.
/// Nothing when the error of one of them is above `ofInterest`.
std::optional<Split> redivide(const Split& split, std::vector<double> bias, double standOff, double ofInterest,
                              const SignedDistance& solid, const SplitSettings& settings);

}  // namespace cairn::builder
