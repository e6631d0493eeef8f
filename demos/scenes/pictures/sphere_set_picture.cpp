// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/sphere_set_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::scenes {
namespace {

/// In units of the bounding box's diagonal.
constexpr double kPanel = 1.12, kRow = 1.34, kLabelBelow = 0.6, kScaleRoom = 0.62, kMinWidth = 3.4;

double widthOf(const SphereSheet& sheet) {
  return std::max(kMinWidth, kPanel * static_cast<double>(sheet.front().size()));
}

double heightOf(const SphereSheet& sheet) {
  return kRow * static_cast<double>(sheet.size()) + kScaleRoom;
}

}  // namespace

PictureSize sphereSetPictureSize(const SphereSheet& sheet, std::uint32_t width) {
  return {width, static_cast<std::uint32_t>(std::lround(width * heightOf(sheet) / widthOf(sheet)))};
}

std::string sphereSetPicture(const builder::TriangleMesh& mesh, const SphereSheet& sheet, const MeshView& view) {
  const PictureFrame frame(mesh.vertices, view);
  const double height = heightOf(sheet);
  std::string text = spherePreamble(widthOf(sheet), height, 0);
  for (std::size_t row = 0; row < sheet.size(); ++row) {
    const double z = height / 2 - kRow * (static_cast<double>(row) + 0.47);
    for (std::size_t column = 0; column < sheet[row].size(); ++column) {
      const SphereSet& set = sheet[row][column];
      const double x = kPanel * (static_cast<double>(column) - (static_cast<double>(sheet[row].size()) - 1) / 2);
      text += "union {\n";
      for (const builder::Ball& ball : set.balls)
        text += sphereText(frame(ball.center), ball.radius * frame.scale(),
                           std::max(0.0, ball.standOff()) * frame.scale(), 0);
      text += fmt::format("translate <{:.5g},0,{:.5g}> }}\n", x, z);
      text += labelText(set.heading, set.line, x, z - kLabelBelow);
    }
  }
  return text + colorScaleText(-height / 2 + 0.27);
}

}  // namespace cairn::scenes
