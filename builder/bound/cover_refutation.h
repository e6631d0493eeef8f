// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bound/center_search.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// Weights that show that too few balls cannot cover; by point, zeros included.
struct Refutation {
  std::vector<std::uint64_t> weights;
  std::uint64_t mostInOneBall = 0;
};

/// Up to so many spheres, proofs are close to the truth and worth the finest search.
inline constexpr std::uint32_t kFewSpheres = 16;

/// Tries to prove that balls which protrude by at most a given error cannot cover given points of a surface.
class CoverRefuter {
 public:
  /// Keeps references; `points` are of the solid's surface, mesh frame, displaced by no more than `spreadOverSurface`
  /// says.
  CoverRefuter(const SignedDistance& solid, const std::vector<Vec3d>& points) : solid_(solid), points_(points) {}

  /// Nothing when no proof was found, which says nothing. `keepOn` is asked between rounds; false ends the attempt.
  /// Deterministic, but an attempt profits from what former ones learned.
  std::optional<Refutation> refute(std::uint32_t spheres, double error, const std::function<bool()>& keepOn);

 private:
  const SignedDistance& solid_;
  const std::vector<Vec3d>& points_;
  std::vector<Vec3d> centers_;  ///< of balls that were in the way before; relative to the search's origin
};

}  // namespace cairn::builder
