// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bound/center_search.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Weights that prove that too few balls cannot cover; one weight by point, zeros included.
struct Refutation {
  std::vector<std::uint64_t> weights;
  std::uint64_t mostInOneBall = 0;
};

/// Up to this number of spheres, proofs are close to the truth and worth the finest search.
inline constexpr std::uint32_t kFewSpheres = 16;

/// Tries to prove that balls which protrude by at most a given error cannot cover given points of a surface.
///
///     CoverRefuter refuter(distance, points);
///     std::optional<Refutation> proof = refuter.refute(64, error, keepOn);
class CoverRefuter {
 public:
  /// Keeps references. `points` lie on the solid's surface (mesh frame), up to the displacement stated at
  /// `spreadOverSurface`.
  CoverRefuter(const SignedDistance& solid, const std::vector<Vec3d>& points) : solid_(solid), points_(points) {}

  /// Returns nothing when no proof was found; this does not show that a cover exists. `keepOn` is called between
  /// rounds; false ends the attempt. Deterministic. Later attempts profit from the centres that earlier attempts found.
  std::optional<Refutation> refute(std::uint32_t spheres, double error, const std::function<bool()>& keepOn);

 private:
  const SignedDistance& solid_;
  const std::vector<Vec3d>& points_;
  std::vector<Vec3d> centers_;  ///< of balls that prevented earlier proofs; relative to the search's origin
};

}  // namespace cairn::builder
