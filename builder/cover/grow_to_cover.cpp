// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/grow_to_cover.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "cover/divide.h"

namespace cairn::builder {

void growToCover(SphereSet& balls, Pieces pieces, double finest) {
  // With the radius in place of the depth, the cost of a piece for a ball is the growth that the ball needs.
  SphereSet asTheyAre = balls;
  for (Ball& ball : asTheyAre) ball.depth = ball.radius;
  const std::vector<double> unbiased(balls.size(), 0);
  const std::vector<Pieces> parts = divide(std::move(pieces), asTheyAre, unbiased, 0, finest);
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (const Piece& piece : parts[i])
      for (const Vec3d& corner : piece.corners)
        balls[i].radius = std::max(balls[i].radius, distance(balls[i].center, corner));
}

}  // namespace cairn::builder
