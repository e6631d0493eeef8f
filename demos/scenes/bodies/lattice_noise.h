// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "cairn/core/vec3.h"
#include "scenes/figures/random.h"

namespace cairn::scenes {

/// Smooth noise in [-1, 1]: hashed values at the points of a unit lattice, blended by quintics (Perlin 2002).
class LatticeNoise {
 public:
  explicit LatticeNoise(std::uint64_t seed) : seed_(seed) {}

  double operator()(const Vec3d& p) const {
    const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    const Vec3d weight{fade(p.x - cell.x), fade(p.y - cell.y), fade(p.z - cell.z)};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double share = 1;
      Vec3d at = cell;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = (corner >> axis) & 1;
        at[axis] += upper;
        share *= upper ? weight[axis] : 1 - weight[axis];
      }
      sum += share * valueAt(at);
    }
    return sum;
  }

 private:
  static double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
  double valueAt(const Vec3d& p) const {
    std::uint64_t hash = seed_;
    for (int axis = 0; axis < 3; ++axis)
      hash = mixBits(hash + static_cast<std::uint64_t>(static_cast<std::int64_t>(p[axis])));
    return static_cast<double>(hash >> 11) * 0x1.0p-52 - 1;
  }

  std::uint64_t seed_;
};

}  // namespace cairn::scenes
