// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <iterator>
#include <utility>
#include <vector>

#include "cairn/builder/grain.h"
#include "surface/mass_properties.h"
#include "surface/union_mass.h"

namespace cairn::builder {
namespace {

/// A line a sphere: x, y, z and r with `between` between them and `end` behind; {} prints the shortest digits that read
/// back as the same number.
std::string lines(const std::vector<Ball>& balls, const char* between, const char* end) {
  std::string text;
  for (const Ball& ball : balls)
    fmt::format_to(std::back_inserter(text), "{}{}{}{}{}{}{}{}\n", ball.center.x, between, ball.center.y, between,
                   ball.center.z, between, ball.radius, end);
  return text;
}

/// The spheres about the grain's centre of mass; along its principal axes where asked.
std::vector<Ball> centred(const Grain& grain, bool principal) {
  std::vector<Ball> balls(grain.balls.begin(), grain.balls.end());
  const Mat3d toAxes = principal ? transpose(grain.mass.principalAxes) : Mat3d{};
  for (Ball& ball : balls) ball.center = toAxes * (ball.center - grain.mass.centerOfMass);
  return balls;
}

}  // namespace

MassProperties massOf(const TriangleMesh& mesh) {
  return massPropertiesOf(mesh);
}

MassProperties massOf(std::span<const Ball> balls) {
  // About their mean, so that balls far from the origin lose no digits.
  Vec3d mean;
  for (const Ball& ball : balls) mean += ball.center - balls[0].center;
  const Vec3d reference = balls[0].center + mean / static_cast<double>(balls.size());
  return massFromMoments(unionMoments(balls, reference), reference);
}

std::string liggghtsText(const Grain& grain) {
  return lines(centred(grain, false), " ", "");
}

std::string yadeText(const Grain& grain) {
  return "#format x_y_z_r_clumpId\n" + lines(centred(grain, false), " ", " 0");
}

std::string chronoText(const Grain& grain) {
  return "x,y,z,r\n" + lines(centred(grain, true), ",", "");
}

std::string clumpText(const Grain& grain) {
  return lines({grain.balls.begin(), grain.balls.end()}, ",", "");
}

}  // namespace cairn::builder
