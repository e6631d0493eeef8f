// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "rockfall/outputs/svg.h"
#include "rockfall/validation/report.h"

namespace cairn::rockfall {
namespace {

constexpr double kPanelWidth = 410, kPanelHeight = 210, kLeft = 62, kTop = 62, kAcross = 56, kBetween = 66, kRight = 20,
                 kBottom = 50;    // pixels
constexpr double kBeyond = 0.02;  // of the span, left free at either end

struct Curve {
  const char* name;
  const Stops ProfileComparison::*of;
  const char* style;
};
constexpr std::array kCurves{
    Curve{"measured", &ProfileComparison::measured, "fill:none;stroke:#222;stroke-width:2"},
    Curve{"simulated", &ProfileComparison::simulated, "fill:none;stroke:#d1495b;stroke-width:2"},
    Curve{"published (Rockable)", &ProfileComparison::published,
          "fill:none;stroke:#00798c;stroke-width:1.6;stroke-dasharray:6 4"}};

struct Axis {
  const char* label;
  Distribution Stops::*of;
};
constexpr std::array kAxes{Axis{"run-out down the slope (m)", &Stops::runoutM},
                           Axis{"lateral place where it stopped (m)", &Stops::lateralM}};

/// One panel: the shares of blocks that stopped before each value.
class Panel {
 public:
  Panel(Svg& svg, double left, double top, double low, double high)
      : svg_(svg), left_(left), top_(top), low_(low), high_(high) {}

  void drawFrame(const std::string& label) {
    svg_.rectangle(left_, top_, kPanelWidth, kPanelHeight, "fill:#fafafa;stroke:#444");
    for (int quarter = 0; quarter <= 4; ++quarter) {
      const double share = 0.25 * quarter;
      svg_.line(left_, y(share), left_ + kPanelWidth, y(share), "stroke:#ddd");
      svg_.text(left_ - 8, y(share) + 4, fmt::format("{:.0f} %", 100 * share), 12, Svg::Anchor::end);
    }
    const double step = tickStep(high_ - low_, 9);
    for (double mark = std::ceil(low_ / step) * step; mark <= high_; mark += step) {
      svg_.line(x(mark), top_ + kPanelHeight, x(mark), top_ + kPanelHeight + 5, "stroke:#444");
      svg_.text(x(mark), top_ + kPanelHeight + 18, fmt::format("{:g}", mark + 0.0), 12, Svg::Anchor::middle);
    }
    svg_.text(left_ + kPanelWidth / 2, top_ + kPanelHeight + 36, label, 13, Svg::Anchor::middle);
  }

  void draw(const Distribution& values, const char* style) {
    std::vector<std::array<double, 2>> points{{x(low_), y(0)}};
    const auto count = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double at = x(values.values()[i]);
      points.push_back({at, y(static_cast<double>(i) / count)});
      points.push_back({at, y(static_cast<double>(i + 1) / count)});
    }
    points.push_back({x(high_), y(1)});
    svg_.polyline(points, style);
  }

 private:
  double x(double value) const { return left_ + kPanelWidth * (value - low_) / (high_ - low_); }
  double y(double share) const { return top_ + kPanelHeight * (1 - share); }

  Svg& svg_;
  double left_, top_, low_, high_;
};

void drawPanel(Svg& svg, const ProfileComparison& profile, const Axis& axis, double left, double top) {
  double low = 1e300, high = -1e300;
  for (const Curve& curve : kCurves)
    if (const Distribution& values = (profile.*curve.of).*axis.of; !values.empty()) {
      low = std::min(low, values.values().front());
      high = std::max(high, values.values().back());
    }
  const double beyond = std::max(kBeyond * (high - low), 0.1);
  Panel panel(svg, left, top, low - beyond, high + beyond);
  panel.drawFrame(axis.label);
  for (const Curve& curve : kCurves)
    if (const Distribution& values = (profile.*curve.of).*axis.of; !values.empty()) panel.draw(values, curve.style);
}

void drawLegend(Svg& svg) {
  double x = kLeft;
  for (const Curve& curve : kCurves) {
    svg.line(x, 22, x + 28, 22, curve.style);
    svg.text(x + 34, 26, curve.name, 13);
    x += 130;
  }
}

}  // namespace

std::string validationFigure(std::span<const ProfileComparison> profiles) {
  const auto rows = static_cast<double>(profiles.size());
  Svg svg(kLeft + 2 * kPanelWidth + kAcross + kRight, kTop + rows * (kPanelHeight + kBetween) - kBetween + kBottom);
  drawLegend(svg);
  double top = kTop;
  for (const ProfileComparison& profile : profiles) {
    svg.text(kLeft, top - 8,
             fmt::format("{}: share of blocks that stopped before ({})", profile.name,
                         profile.isCalibrated ? "calibrated" : "predicted blind"),
             13);
    for (std::size_t i = 0; i < kAxes.size(); ++i)
      drawPanel(svg, profile, kAxes[i], kLeft + static_cast<double>(i) * (kPanelWidth + kAcross), top);
    top += kPanelHeight + kBetween;
  }
  return std::move(svg).finish();
}

}  // namespace cairn::rockfall
