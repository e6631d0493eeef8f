// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/figures/random.h"

#include <cmath>

namespace cairn::scenes {
namespace {

constexpr std::uint64_t kGoldenGamma = 0x9E3779B97F4A7C15ULL;

/// A uniform point of the unit disc, and its squared distance from the centre.
struct DiscPoint {
  double x, y, radiusSq;
};

DiscPoint discPoint(Random& random) {
  while (true) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double radiusSq = x * x + y * y;
    if (radiusSq < 1 && radiusSq > 0) return {x, y, radiusSq};
  }
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : key_(mixBits(mixBits(seed + kGoldenGamma) + kGoldenGamma * (stream + 1))) {}

std::uint64_t Random::bits() {
  return mixBits(key_ + kGoldenGamma * ++counter_);
}

double Random::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

Vec3d Random::direction() {
  const DiscPoint p = discPoint(*this);
  const double stretch = 2 * std::sqrt(1 - p.radiusSq);
  return {p.x * stretch, p.y * stretch, 1 - 2 * p.radiusSq};
}

btQuaternion Random::rotation() {
  const DiscPoint p = discPoint(*this);
  const DiscPoint q = discPoint(*this);
  const double stretch = std::sqrt((1 - p.radiusSq) / q.radiusSq);
  btQuaternion rotation(static_cast<btScalar>(p.x), static_cast<btScalar>(p.y), static_cast<btScalar>(q.x * stretch),
                        static_cast<btScalar>(q.y * stretch));
  return rotation.normalized();
}

}  // namespace cairn::scenes
