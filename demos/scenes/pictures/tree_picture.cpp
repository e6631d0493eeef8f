// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/tree_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cairn::scenes {
namespace {

constexpr std::uint32_t kDeepestLevel = 3;
/// Lengths of the picture, in diagonals of the mesh's bounding box.
constexpr double kPictureHeight = 1.78;
constexpr double kPictureWidth = kPictureHeight * kTreePictureSize.width / kTreePictureSize.height;
constexpr double kPictureMiddle = -0.36;
constexpr double kPanelWidth = 1.03;
constexpr double kLabelHeight = -0.66;
constexpr double kScaleHeight = -1.05;

/// Coarse spheres are transparent and show the mesh inside. Fine spheres represent the object itself.
std::string levelText(const SphereTree& tree, std::uint32_t level, const PictureFrame& frame) {
  const bool isCoarse = level < 2;
  std::string text = isCoarse ? "object { Body texture { BodyTexture } }\n" : "";
  for (const NodeId node : tree.levelCut(level)) {
    const Sphere sphere = tree.sphere(node);
    text += sphereText(frame(Vec3d(sphere.center)), sphere.radius * frame.scale(), tree.error(node) * frame.scale(),
                       isCoarse ? 0.62 - 0.22 * level : 0);
  }
  return text;
}

}  // namespace

std::string treePicture(const SphereTree& tree, const MeshView& view) {
  std::vector<Vec3d> vertices;
  for (const Vec3& v : tree.vertices()) vertices.emplace_back(v);
  const PictureFrame frame(vertices, view);
  for (Vec3d& v : vertices) v = frame(v);
  const std::uint32_t levels = std::min(tree.depth(), kDeepestLevel) + 1;
  const auto panelX = [&](std::uint32_t panel) { return (panel - 0.5 * levels) * kPanelWidth; };

  std::string text =
      spherePreamble(kPictureWidth, kPictureHeight, kPictureMiddle) + povrayMesh("Body", vertices, tree.triangles());
  text += fmt::format("object {{ Body texture {{ BodyTexture }} translate x*{:.5g} }}\n", panelX(0));
  text += labelText("mesh", fmt::format("{} triangles", tree.triangles().size()), panelX(0), kLabelHeight);
  for (std::uint32_t level = 0; level < levels; ++level) {
    const double x = panelX(level + 1);
    text += fmt::format("union {{\n{}translate x*{:.5g} }}\n", levelText(tree, level, frame), x);
    const std::size_t spheres = tree.levelCut(level).size();
    text += labelText(fmt::format("level {}", level),
                      fmt::format("{} sphere{}, error up to {:.2g} %", spheres, spheres == 1 ? "" : "s",
                                  100 * tree.levelError(level) * frame.scale()),
                      x, kLabelHeight);
  }
  return text + colorScaleText(kScaleHeight);
}

}  // namespace cairn::scenes
