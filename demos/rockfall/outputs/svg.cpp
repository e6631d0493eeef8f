// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/svg.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <iterator>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "scenes/command/subprocess.h"

namespace cairn::rockfall {
namespace {

std::string escaped(const std::string& words) {
  std::string text;
  for (const char c : words) text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return text;
}

const char* nameOf(Svg::Anchor anchor) {
  return anchor == Svg::Anchor::start ? "start" : anchor == Svg::Anchor::middle ? "middle" : "end";
}

Error missingRenderer() {
  return Error{"rsvg-convert is needed to draw PNG figures: install the package librsvg2-bin, or leave out --png"};
}

}  // namespace

Svg::Svg(double width, double height)
    : text_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
                        "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"DejaVu Sans, sans-serif\">\n",
                        width, height)) {
  rectangle(0, 0, width, height, "fill:#fff");
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& style) {
  fmt::format_to(std::back_inserter(text_),
                 "<rect x=\"{:.6g}\" y=\"{:.6g}\" width=\"{:.6g}\" height=\"{:.6g}\" style=\"{}\"/>\n", x, y, width,
                 height, style);
}

void Svg::line(double x0, double y0, double x1, double y1, const std::string& style) {
  fmt::format_to(std::back_inserter(text_),
                 "<line x1=\"{:.6g}\" y1=\"{:.6g}\" x2=\"{:.6g}\" y2=\"{:.6g}\" style=\"{}\"/>\n", x0, y0, x1, y1,
                 style);
}

void Svg::polyline(std::span<const std::array<double, 2>> points, const std::string& style) {
  text_ += "<polyline points=\"";
  for (const auto& [x, y] : points) fmt::format_to(std::back_inserter(text_), "{:.2f},{:.2f} ", x, y);
  fmt::format_to(std::back_inserter(text_), "\" style=\"fill:none;{}\"/>\n", style);
}

void Svg::circle(double x, double y, double radius, const std::string& style) {
  fmt::format_to(std::back_inserter(text_), "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.3g}\" style=\"{}\"/>\n", x, y,
                 radius, style);
}

void Svg::path(const std::string& commands, const std::string& style) {
  fmt::format_to(std::back_inserter(text_), "<path d=\"{}\" style=\"{}\"/>\n", commands, style);
}

void Svg::text(double x, double y, const std::string& words, double size, Anchor anchor) {
  fmt::format_to(std::back_inserter(text_),
                 "<text x=\"{:.6g}\" y=\"{:.6g}\" font-size=\"{:g}\" text-anchor=\"{}\">{}</text>\n", x, y, size,
                 nameOf(anchor), escaped(words));
}

void Svg::uprightText(double x, double y, const std::string& words, double size) {
  fmt::format_to(std::back_inserter(text_),
                 "<text transform=\"translate({:.6g} {:.6g}) rotate(-90)\" font-size=\"{:g}\" "
                 "text-anchor=\"middle\">{}</text>\n",
                 x, y, size, escaped(words));
}

void Svg::beginClip(double x, double y, double width, double height) {
  ++clips_;
  fmt::format_to(std::back_inserter(text_),
                 "<clipPath id=\"c{0}\"><rect x=\"{1:.6g}\" y=\"{2:.6g}\" width=\"{3:.6g}\" "
                 "height=\"{4:.6g}\"/></clipPath>\n<g clip-path=\"url(#c{0})\">\n",
                 clips_, x, y, width, height);
}

void Svg::endClip() {
  text_ += "</g>\n";
}

std::string Svg::finish() && {
  return std::move(text_) + "</svg>\n";
}

double tickStep(double span, int most) {
  double power = std::pow(10.0, std::floor(std::log10(span / most)));
  while (true) {
    for (const double digit : {1.0, 2.0, 5.0})
      if (span / (digit * power) <= most) return digit * power;
    power *= 10;
  }
}

Status renderSvg(const std::filesystem::path& svg, const std::filesystem::path& png) {
  return writeFileAtomically(png, [&](const std::filesystem::path& temporary) -> Status {
    const int code = scenes::runCommand({"rsvg-convert", "-o", temporary.string(), svg.string()}, "/dev/null");
    if (code == -ENOENT) return missingRenderer();
    if (code != 0) return Error{fmt::format("rsvg-convert could not draw {}", svg.string())};
    return {};
  });
}

Status checkRenderer() {
  if (scenes::runCommand({"rsvg-convert", "--version"}, "/dev/null") != 0) return missingRenderer();
  return {};
}

}  // namespace cairn::rockfall
