// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "evaluate/line_parts.h"
#include "surface/signed_distance.h"

namespace cairn::builder {

/// A volume measured by random samples, cubic mesh units.
struct VolumeEstimate {
  double value = 0;
  double standardError = 0;  ///< estimated from the samples' own variance
};

/// Estimates the volume in the balls and outside the solid: V_w of thesis 7.1.1, by its mean-sample method. The length
/// of a z-parallel line's parts is integrated over the plane by MISER (Press and Farrar 1990, GNU Scientific Library).
/// About 100 000 lines. The same seed gives the same bits.
VolumeEstimate wastedVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed);

/// Estimates the volume in the solid and in none of the balls: V_u of thesis 7.1.1. Method and cost are those of
/// `wastedVolume`.
VolumeEstimate uncoveredVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed);

/// Depth below the surface of the solid's uncovered part, mesh units; 0 without such a part. No ball detects a body
/// that is there. Random points on 20 000 evenly spread lines are measured, so `max` is a lower bound of the truth.
struct UncoveredDepth {
  double max = 0;
  double rms = 0;  ///< root mean square over the uncovered volume
};
UncoveredDepth uncoveredDepth(const SignedDistance& distance, const SolidLines& solid, const BallLines& balls,
                              std::uint64_t seed);

}  // namespace cairn::builder
