// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/sampled_protrusion.h"

#include <algorithm>
#include <vector>

#include "surface/icosphere.h"

namespace cairn::builder {

double sampledProtrusion(const SignedDistance& solid, const Vec3d& center, double radius) {
  static const std::vector<Vec3d> kDirections = unitIcosphere(3).vertices;
  double worst = 0;
  for (const Vec3d& direction : kDirections) worst = std::max(worst, -solid.depth(center + direction * radius));
  return worst;
}

}  // namespace cairn::builder
