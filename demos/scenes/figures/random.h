// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <LinearMath/btQuaternion.h>

#include <cstdint>

#include "cairn/core/mix_bits.h"
#include "cairn/core/vec3.h"

namespace cairn::scenes {

/// Counter-based random numbers. The n-th number of a stream is a pure function of (seed, stream, n), so a new consumer
/// never shifts the numbers of another. Two rounds of the SplitMix64 finaliser (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint64_t bits();
  /// In [0, 1), all 53 bits of a double.
  double uniform();
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform on the unit sphere (Marsaglia 1972). Without trigonometry, so every C library gives the same bits.
  Vec3d direction();
  /// Uniform over all rotations (Marsaglia 1972).
  btQuaternion rotation();

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace cairn::scenes
