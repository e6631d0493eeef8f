// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/sampled_protrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cairn::builder {
namespace {

constexpr int kPoints = 1000;

/// Unit directions on a Fibonacci spiral: near-equal areas for any number (Gonzalez 2010).
std::array<Vec3d, kPoints> spiral() {
  const double goldenAngle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::array<Vec3d, kPoints> directions;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - (2 * i + 1.0) / kPoints;
    const double ring = std::sqrt(1 - z * z);
    directions[i] = {ring * std::cos(goldenAngle * i), ring * std::sin(goldenAngle * i), z};
  }
  return directions;
}

}  // namespace

double sampledProtrusion(const SignedDistance& solid, const Vec3d& center, double radius) {
  static const std::array<Vec3d, kPoints> kDirections = spiral();
  double worst = 0;
  for (const Vec3d& direction : kDirections) worst = std::max(worst, -solid.depth(center + direction * radius));
  return worst;
}

}  // namespace cairn::builder
