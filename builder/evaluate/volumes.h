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

/// The volume in the balls and outside the solid, V_w of thesis 7.1.1, by its mean-sample method: the length of what a
/// line along z meets, integrated over the plane by MISER (Press and Farrar 1990, as in the GNU Scientific Library).
/// Some 100 000 lines; the same seed gives the same bits.
VolumeEstimate wastedVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed);

/// The volume in the solid and in none of the balls, V_u of thesis 7.1.1, likewise.
VolumeEstimate uncoveredVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed);

/// How deep below the surface the solid lies in none of the balls, mesh units; 0 without such a place. A body that got
/// there is felt by no ball. Random points on 20 000 lines spread evenly: `max` is a lower bound of the truth.
struct UncoveredDepth {
  double max = 0;
  double rms = 0;  ///< root mean square over the uncovered volume
};
UncoveredDepth uncoveredDepth(const SignedDistance& distance, const SolidLines& solid, const BallLines& balls,
                              std::uint64_t seed);

}  // namespace cairn::builder
