// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/pictures/line_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace cairn::scenes {
namespace {

// Width of a line as a fraction of the picture's width, and the free border.
constexpr double kLineWidth = 0.0005, kBorder = 1.03;

struct Frame {
  btVector3 lower{SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY}, upper = -lower;

  explicit Frame(std::span<const LineRecorder::Line> lines) {
    for (const LineRecorder::Line& line : lines)
      for (const btVector3& end : {line.from, line.to}) {
        lower.setMin(end);
        upper.setMax(end);
      }
  }
  // World length of the picture's width.
  double width() const {
    const double aspect = double(kLinePictureSize.width) / kLinePictureSize.height;
    return kBorder * std::max(double(upper.x() - lower.x()), aspect * double(upper.z() - lower.z()));
  }
};

std::string camera(const Frame& frame) {
  const btVector3 middle = (frame.lower + frame.upper) / 2;
  const double width = frame.width(), height = width * kLinePictureSize.height / kLinePictureSize.width;
  const double before = double(frame.lower.y()) - width;
  return fmt::format(
      "#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\nbackground {{ srgb <0.07,0.08,0.10> }}\n"
      "camera {{ orthographic location <{0:.6g},{1:.6g},{2:.6g}> right x*{3:.6g} up z*{4:.6g} direction y }}\n",
      double(middle.x()), before, double(middle.z()), width, height);
}

}  // namespace

void LineRecorder::drawLine(const btVector3& from, const btVector3& to, const btVector3& color) {
  // POV-Ray refuses cylinders without a length.
  if ((to - from).length2() > 0) lines_.push_back({from, to, color});
}

std::string linePicture(std::span<const LineRecorder::Line> lines) {
  assert(!lines.empty());
  const Frame frame(lines);
  const double radius = kLineWidth / 2 * frame.width();
  std::string text = camera(frame);
  for (const LineRecorder::Line& line : lines)
    text += fmt::format(
        "cylinder {{ <{:.6g},{:.6g},{:.6g}>, <{:.6g},{:.6g},{:.6g}>, {:.4g} open pigment {{ srgb "
        "<{:.3g},{:.3g},{:.3g}> }} "
        "finish {{ ambient 0 emission 1 diffuse 0 }} }}\n",
        double(line.from.x()), double(line.from.y()), double(line.from.z()), double(line.to.x()), double(line.to.y()),
        double(line.to.z()), radius, double(line.color.x()), double(line.color.y()), double(line.color.z()));
  return text;
}

}  // namespace cairn::scenes
