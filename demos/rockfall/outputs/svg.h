// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// A picture in SVG 1.1, in the making. Pixels, x to the right, y down.
class Svg {
 public:
  Svg(double width, double height);

  enum class Anchor { start, middle, end };
  void rectangle(double x, double y, double width, double height, const std::string& style);
  void line(double x0, double y0, double x1, double y1, const std::string& style);
  void polyline(std::span<const std::array<double, 2>> points, const std::string& style);
  void circle(double x, double y, double radius, const std::string& style);
  /// Commands of a path element.
  void path(const std::string& commands, const std::string& style);
  void text(double x, double y, const std::string& words, double size, Anchor anchor = Anchor::start);
  /// Turned to read upwards.
  void uprightText(double x, double y, const std::string& words, double size);
  /// What is drawn between the two calls shows inside the rectangle only.
  void beginClip(double x, double y, double width, double height);
  void endClip();

  std::string finish() &&;

 private:
  std::string text_;
  int clips_ = 0;
};

/// A rising axis: its least step of 1, 2 or 5 times a power of ten that leaves at most `most` marks over the span.
double tickStep(double span, int most);

/// Draws an SVG with the program rsvg-convert (Debian's librsvg2-bin) to a PNG that is written completely or not at
/// all. Fails with one sentence if the program is missing.
Status renderSvg(const std::filesystem::path& svg, const std::filesystem::path& png);
/// Whether it is there.
Status checkRenderer();

}  // namespace cairn::rockfall
