// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "cairn/core/result.h"

namespace cairn::rockfall {

/// Builds a picture in SVG 1.1. Pixels, x to the right, y down.
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
  /// Text turned to read upwards.
  void uprightText(double x, double y, const std::string& words, double size);
  /// Drawings between the two calls are visible only inside the rectangle.
  void beginClip(double x, double y, double width, double height);
  void endClip();

  std::string finish() &&;

 private:
  std::string text_;
  int clips_ = 0;
};

/// Returns the step of an axis: the least of 1, 2 or 5 times a power of ten that gives at most `most` marks over the
/// span.
double tickStep(double span, int most);

/// Converts an SVG with the program rsvg-convert (Debian's librsvg2-bin) to a PNG, which is written completely or not
/// at all. Fails with one sentence if the program is missing.
Status renderSvg(const std::filesystem::path& svg, const std::filesystem::path& png);
/// Fails when rsvg-convert is missing.
Status checkRenderer();

}  // namespace cairn::rockfall
