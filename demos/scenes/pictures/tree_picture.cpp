// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/tree_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "cairn/bullet/tree_drawing.h"

namespace cairn::scenes {
namespace {

constexpr std::uint32_t kDeepestLevel = 3;
/// The mesh is seen from this far above the horizontal.
constexpr double kTiltDegrees = 14;
/// Lengths of the picture, in diagonals of the mesh's bounding box.
constexpr double kPictureHeight = 1.78;
constexpr double kPictureWidth = kPictureHeight * kTreePictureSize.width / kTreePictureSize.height;
constexpr double kPictureMiddle = -0.36;
constexpr double kPanelWidth = 1.03;
constexpr double kLabelHeight = -0.66;
constexpr double kScaleHeight = -1.05;

std::string srgb(const btVector3& c) {
  return fmt::format("srgb <{:.3f},{:.3f},{:.3f}>", double(c.x()), double(c.y()), double(c.z()));
}

/// The tree in picture units: diagonal 1, bounding box centred, turned and tilted: x right, z up, seen along +y.
class PictureFrame {
 public:
  PictureFrame(const SphereTree& tree, const TreePictureOptions& options) : up_(options.up) {
    const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
    turn_ = {std::cos(radians(options.turnDegrees)), std::sin(radians(options.turnDegrees))};
    tilt_ = {std::cos(radians(kTiltDegrees)), std::sin(radians(kTiltDegrees))};
    Vec3d lower(tree.vertices()[0]), upper = lower;
    for (const Vec3& v : tree.vertices())
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], static_cast<double>(v[axis]));
        upper[axis] = std::max(upper[axis], static_cast<double>(v[axis]));
      }
    center_ = (lower + upper) * 0.5;
    scale_ = 1 / length(upper - lower);
  }

  double scale() const { return scale_; }
  Vec3d operator()(const Vec3& p) const {
    Vec3d q = (Vec3d(p) - center_) * scale_;
    if (up_ == UpAxis::y) q = {q.x, -q.z, q.y};
    q = {turn_.cosine * q.x - turn_.sine * q.y, turn_.sine * q.x + turn_.cosine * q.y, q.z};
    return {q.x, tilt_.cosine * q.y - tilt_.sine * q.z, tilt_.sine * q.y + tilt_.cosine * q.z};
  }

 private:
  struct Angle {
    double cosine, sine;
  };

  UpAxis up_;
  Angle turn_, tilt_;
  Vec3d center_;
  double scale_;
};

std::string preamble() {
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
                     kPictureWidth, kPictureHeight, kPictureMiddle);
}

std::string sphereText(const Vec3d& center, double radius, double errorFraction, double transmit) {
  return fmt::format("sphere {{ {}, {:.5g} pigment {{ {} transmit {:.2f} }} finish {{ Matt }} }}\n",
                     povrayVector(center), radius, srgb(bullet::errorColor(errorFraction)), transmit);
}

/// Coarse spheres are glassy and show the mesh within; fine ones stand for the object themselves.
std::string levelText(const SphereTree& tree, std::uint32_t level, const PictureFrame& frame) {
  const bool isCoarse = level < 2;
  std::string text = isCoarse ? "object { Body texture { BodyTexture } }\n" : "";
  for (const NodeId node : tree.levelCut(level)) {
    const Sphere sphere = tree.sphere(node);
    text += sphereText(frame(sphere.center), sphere.radius * frame.scale(), tree.error(node) * frame.scale(),
                       isCoarse ? 0.62 - 0.22 * level : 0);
  }
  return text;
}

/// A heading and a line below it, centred under a panel.
std::string labelText(const std::string& heading, const std::string& line, double x) {
  return fmt::format("Label(\"{}\", 0.1, {:.5g}, {:.5g})\nLabel(\"{}\", 0.064, {:.5g}, {:.5g})\n", heading, x,
                     kLabelHeight, line, x, kLabelHeight - 0.12);
}

std::string scaleText() {
  constexpr double kLength = 3.0, kHeight = 0.07, z = kScaleHeight;
  constexpr int kCells = 240;
  constexpr double kRange = bullet::kGreatestErrorShown / bullet::kLeastErrorShown;
  std::string text;
  for (int i = 0; i < kCells; ++i) {
    const double left = kLength * (static_cast<double>(i) / kCells - 0.5);
    text += fmt::format(
        "box {{ <{:.5g},-0.01,{:.5g}>, <{:.5g},0.01,{:.5g}> no_shadow pigment {{ {} }} finish {{ ambient 0 diffuse 0 "
        "emission 1 }} }}\n",
        left, z - kHeight / 2, left + kLength / kCells * 1.02, z + kHeight / 2,
        srgb(bullet::errorColor(bullet::kLeastErrorShown * std::pow(kRange, (i + 0.5) / kCells))));
  }
  for (const double tick : {0.003, 0.01, 0.03, 0.1, 0.3})
    text += fmt::format("Label(\"{:.3g} %\", 0.064, {:.5g}, {:.5g})\n", 100 * tick,
                        kLength * (bullet::onErrorScale(tick) - 0.5), z - kHeight / 2 - 0.085);
  text += fmt::format(
      "Label(\"certified error: how far a sphere can stick out of the object, in % of its size\", 0.064, 0, {:.5g})\n",
      z + kHeight / 2 + 0.06);
  return text;
}

}  // namespace

std::string treePicture(const SphereTree& tree, const TreePictureOptions& options) {
  const PictureFrame frame(tree, options);
  std::vector<Vec3d> vertices;
  for (const Vec3& v : tree.vertices()) vertices.push_back(frame(v));
  const std::uint32_t levels = std::min(tree.depth(), kDeepestLevel) + 1;
  const auto panelX = [&](std::uint32_t panel) { return (panel - 0.5 * levels) * kPanelWidth; };

  std::string text = preamble() + povrayMesh("Body", vertices, tree.triangles());
  text += fmt::format("object {{ Body texture {{ BodyTexture }} translate x*{:.5g} }}\n", panelX(0));
  text += labelText("mesh", fmt::format("{} triangles", tree.triangles().size()), panelX(0));
  for (std::uint32_t level = 0; level < levels; ++level) {
    const double x = panelX(level + 1);
    text += fmt::format("union {{\n{}translate x*{:.5g} }}\n", levelText(tree, level, frame), x);
    const std::size_t spheres = tree.levelCut(level).size();
    text += labelText(fmt::format("level {}", level),
                      fmt::format("{} sphere{}, error up to {:.2g} %", spheres, spheres == 1 ? "" : "s",
                                  100 * tree.levelError(level) * frame.scale()),
                      x);
  }
  return text + scaleText();
}

}  // namespace cairn::scenes
