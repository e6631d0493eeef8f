// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_set.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::builder {

double coverStandOff(const PointSet& points, std::span<const Ball> balls) {
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  std::vector<double> costs(points.size());
  for (const Ball& ball : balls) {
    points.distances(ball.center, ball.depth, costs);
    for (std::size_t p = 0; p < costs.size(); ++p) least[p] = std::min(least[p], costs[p]);
  }
  return *std::max_element(least.begin(), least.end());
}

double closingSpacing(std::span<const Ball> balls, double standOff) {
  constexpr double kMin = 0.15, kBlur = 0.01;
  double radius = 0;
  for (const Ball& ball : balls) radius += ball.radius / static_cast<double>(balls.size());
  return std::max(kMin * standOff, std::sqrt(8 * kBlur * standOff * radius));
}

}  // namespace cairn::builder
