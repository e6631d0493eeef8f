// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/fill_up.h"

#include <limits>

#include "flat/settle_radii.h"

namespace cairn::builder {

SphereSet filledUp(SphereSet balls, std::size_t count, const PointSet& points, const SignedDistance& solid) {
  std::vector<double> room(points.size(), std::numeric_limits<double>::infinity()), distances(points.size());
  const auto leave = [&](const Vec3d& taken) {
    points.distances(taken, 0, distances);
    for (std::size_t p = 0; p < room.size(); ++p) room[p] = std::min(room[p], distances[p]);
  };
  if (balls.size() < count)
    for (const Ball& ball : balls) leave(ball.center);
  while (balls.size() < count) {
    const auto loneliest = static_cast<std::size_t>(std::max_element(room.begin(), room.end()) - room.begin());
    leave(points[loneliest]);
    balls.push_back(innerRadii({Ball{points[loneliest], 0, 0}}, solid).front());
  }
  return balls;
}

}  // namespace cairn::builder
