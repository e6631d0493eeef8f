// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// A ball of a level cut: mesh frame and unit.
struct CutBall {
  Vec3d center;
  double radius = 0;

  bool contains(const Vec3d& p) const { return lengthSq(p - center) <= radius * radius; }
};

/// Share of the mesh's area that lies in none of the balls: systematic sampling along the triangles by area, one random
/// point per stratum. 0 means no sample was outside; the proof is `certify`'s.
double uncoveredAreaFraction(const TriangleMesh& mesh, const std::vector<CutBall>& balls, std::uint64_t seed);

/// Volume of the balls' union outside the solid. Samples are spread over the balls by volume; a point in m balls counts
/// 1/m, which makes the mean unbiased for the union. The standard error is below 1 % of the balls' total volume.
double wastedVolume(const SignedDistance& solid, const std::vector<CutBall>& balls, std::uint64_t seed);

}  // namespace cairn::builder
