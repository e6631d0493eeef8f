// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Random numbers in [0, 1) for one chunk of samples. Seed and chunk give the same numbers on every platform and
/// thread.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t chunk) : engine_(mixed(seed, chunk)) {}

  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  /// Returns a uniformly distributed point of the ball, by rejection from its cube (1.9 trials on average).
  Vec3d inBall(const Vec3d& center, double radius) {
    for (;;) {
      const double x = uniform(), y = uniform(), z = uniform();
      const Vec3d p{2 * x - 1, 2 * y - 1, 2 * z - 1};
      if (lengthSq(p) <= 1) return center + p * radius;
    }
  }

 private:
  /// Mixes both numbers with SplitMix64's finalizer (Steele et al. 2014), so that similar seeds and chunks start
  /// unrelated streams.
  static std::uint64_t mixed(std::uint64_t seed, std::uint64_t chunk) {
    std::uint64_t z = seed + 0x9E3779B97F4A7C15ULL * (chunk + 1);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace cairn::builder
