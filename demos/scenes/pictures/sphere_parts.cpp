// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/sphere_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/bullet/tree_drawing.h"

namespace cairn::scenes {
namespace {

/// The camera looks down at this angle.
constexpr double kTiltDegrees = 14;

std::string srgb(const btVector3& c) {
  return fmt::format("srgb <{:.3f},{:.3f},{:.3f}>", double(c.x()), double(c.y()), double(c.z()));
}

}  // namespace

PictureFrame::PictureFrame(std::span<const Vec3d> vertices, const MeshView& view) : up_(view.up) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  turn_ = {std::cos(radians(view.turnDegrees)), std::sin(radians(view.turnDegrees))};
  tilt_ = {std::cos(radians(kTiltDegrees)), std::sin(radians(kTiltDegrees))};
  Vec3d lower = vertices[0], upper = lower;
  for (const Vec3d& v : vertices)
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], v[axis]);
      upper[axis] = std::max(upper[axis], v[axis]);
    }
  center_ = (lower + upper) * 0.5;
  scale_ = 1 / length(upper - lower);
}

Vec3d PictureFrame::operator()(const Vec3d& p) const {
  Vec3d q = (p - center_) * scale_;
  if (up_ == UpAxis::y) q = {q.x, -q.z, q.y};
  q = {turn_.cosine * q.x - turn_.sine * q.y, turn_.sine * q.x + turn_.cosine * q.y, q.z};
  return {q.x, tilt_.cosine * q.y - tilt_.sine * q.z, tilt_.sine * q.y + tilt_.cosine * q.z};
}

std::string spherePreamble(double width, double height, double middle) {
  return fmt::format(R"(#version 3.7;
global_settings {{ assumed_gamma 1 }}
background {{ srgb 1 }}
camera {{ orthographic location <0,-20,{2:.5g}> sky z right -x*{0:.5g} up z*{1:.5g} look_at <0,0,{2:.5g}> }}
light_source {{ <-12,-16,18> srgb 0.92 parallel point_at 0 area_light x*4, y*4, 4, 4 adaptive 1 jitter circular orient }}
light_source {{ <14,-14,4> srgb 0.34 parallel point_at 0 shadowless }}
#declare Matt = finish {{ ambient 0.32 diffuse 0.78 specular 0.14 roughness 0.04 }}
#declare BodyTexture = texture {{ pigment {{ srgb <0.80,0.77,0.72> }} finish {{ Matt }} }}
#declare Ink = texture {{ pigment {{ srgb <0.16,0.17,0.20> }} finish {{ ambient 0 diffuse 0 emission 1 }} }}
// Text that faces the camera, centred at a place of the picture plane.
#macro Label(Words, Size, X, Z)
  #local T = text {{ internal 2 Words 0.01 0 }};
  object {{ T translate <-(min_extent(T).x + max_extent(T).x) / 2, 0, 0> scale Size scale <1,1,0.01> rotate x*90
            translate <X, 0, Z> no_shadow texture {{ Ink }} }}
#end
)",
                     width, height, middle);
}

std::string sphereText(const Vec3d& center, double radius, double errorFraction, double transmit) {
  return fmt::format("sphere {{ {}, {:.5g} pigment {{ {} transmit {:.2f} }} finish {{ Matt }} }}\n",
                     povrayVector(center), radius, srgb(bullet::errorColor(errorFraction)), transmit);
}

std::string labelText(const std::string& heading, const std::string& line, double x, double z) {
  return fmt::format("Label(\"{}\", 0.1, {:.5g}, {:.5g})\nLabel(\"{}\", 0.064, {:.5g}, {:.5g})\n", heading, x, z, line,
                     x, z - 0.12);
}

std::string colorScaleText(double z) {
  constexpr double kLength = 3.0, kHeight = 0.07;
  constexpr int kCells = 240;
  constexpr double kRange = bullet::kMaxErrorShown / bullet::kMinErrorShown;
  std::string text;
  for (int i = 0; i < kCells; ++i) {
    const double left = kLength * (static_cast<double>(i) / kCells - 0.5);
    text += fmt::format(
        "box {{ <{:.5g},-0.01,{:.5g}>, <{:.5g},0.01,{:.5g}> no_shadow pigment {{ {} }} finish {{ ambient 0 diffuse 0 "
        "emission 1 }} }}\n",
        left, z - kHeight / 2, left + kLength / kCells * 1.02, z + kHeight / 2,
        srgb(bullet::errorColor(bullet::kMinErrorShown * std::pow(kRange, (i + 0.5) / kCells))));
  }
  for (const double tick : {0.003, 0.01, 0.03, 0.1, 0.3})
    text += fmt::format("Label(\"{:.3g} %\", 0.064, {:.5g}, {:.5g})\n", 100 * tick,
                        kLength * (bullet::onErrorScale(tick) - 0.5), z - kHeight / 2 - 0.085);
  text += fmt::format(
      "Label(\"certified error: how far a sphere can stick out of the object, in % of its size\", 0.064, 0, {:.5g})\n",
      z + kHeight / 2 + 0.06);
  return text;
}

}  // namespace cairn::scenes
