// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bound/center_search.h"
#include "cairn/builder/progress.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Weights that prove that too few balls cannot cover; one weight by point, zeros included.
struct Refutation {
  std::vector<std::uint64_t> weights;
  std::uint64_t mostInOneBall = 0;
};

/// Up to this number of spheres, proofs are close to the truth and worth the finest search.
inline constexpr std::uint32_t kFewSpheres = 16;

/// The effort of one attempt. Less of it proves less, sooner.
struct RefutationEffort {
  double maxOutside = 8000;  ///< outside points the search starts with, at most; more are found where they matter
  int maxRounds = 30;        ///< an attempt ends after this many solutions of the linear program
};

/// Tries to prove that balls which protrude by at most a given error cannot cover given points of a surface.
///
///     CoverRefuter refuter(distance, keepGoing);
///     std::optional<Refutation> proof = refuter.refute(points, 64, error);
class CoverRefuter {
 public:
  /// Keeps references.
  CoverRefuter(const SignedDistance& solid, const KeepGoing& keepGoing) : solid_(solid), keepGoing_(keepGoing) {}

  /// Returns nothing when no proof was found; this does not show that a cover exists. `points` lie on the solid's
  /// surface (mesh frame), up to the displacement stated at `spreadOverSurface`. Once `keepGoing` returns false, the
  /// attempt ends soon without a proof. Deterministic. Later attempts profit from the centres that earlier attempts
  /// found.
  std::optional<Refutation> refute(const std::vector<Vec3d>& points, std::uint32_t spheres, double error,
                                   const RefutationEffort& effort = {});

 private:
  const SignedDistance& solid_;
  const KeepGoing& keepGoing_;
  std::vector<Vec3d> centers_;  ///< of balls that prevented earlier proofs; relative to the search's origin
};

}  // namespace cairn::builder
