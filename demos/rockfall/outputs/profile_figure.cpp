// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "rockfall/outputs/figures.h"
#include "rockfall/outputs/svg.h"

namespace cairn::rockfall {
namespace {

constexpr double kWidth = 900, kPanel = 230, kLeft = 80, kTop = 60, kGap = 46, kRight = 30, kBottom = 56;  // pixels

struct Drawn {
  const char* label;
  double unit;  ///< SI units per unit of the axis
  const LogHistogram& (*of)(const CellSummary&);
};

/// A curve of the panel: its quantile in thousandths, or 0 for the greatest.
struct Curve {
  const char* name;
  std::uint32_t thousandths;
  const char* style;
};
constexpr std::array kCurves{Curve{"greatest", 0, "stroke:#9aa5b1;stroke-width:1.4"},
                             Curve{"95 %", 950, "stroke:#d1495b;stroke-width:2"},
                             Curve{"median", 500, "stroke:#00798c;stroke-width:2"}};

double valueOf(const LogHistogram& histogram, const Curve& curve) {
  return curve.thousandths == 0 ? histogram.greatest() : histogram.quantile(curve.thousandths);
}

/// One panel: bottom left corner, scales, and marks.
class Panel {
 public:
  Panel(Svg& svg, double top, double farthest, double greatest, const std::string& label)
      : svg_(svg), bottom_(top + kPanel), farthest_(farthest), greatest_(std::max(greatest * 1.05, 1e-9)) {
    svg_.rectangle(kLeft, top, kWidth, kPanel, "fill:#fafafa;stroke:#444");
    const double step = tickStep(greatest_, 6);
    for (double value = 0; value <= greatest_; value += step) {
      svg_.line(kLeft, y(value), kLeft + kWidth, y(value), "stroke:#ddd");
      svg_.text(kLeft - 8, y(value) + 4, fmt::format("{:g}", value), 12, Svg::Anchor::end);
    }
    svg_.uprightText(22, top + kPanel / 2, label, 13);
  }

  double x(double distance) const { return kLeft + kWidth * distance / farthest_; }
  double y(double value) const { return bottom_ - kPanel * value / greatest_; }

  void drawDistances() {
    const double step = tickStep(farthest_, 12);
    for (double distance = 0; distance <= farthest_; distance += step) {
      svg_.line(x(distance), bottom_, x(distance), bottom_ + 5, "stroke:#444");
      svg_.text(x(distance), bottom_ + 19, fmt::format("{:g}", distance), 12, Svg::Anchor::middle);
    }
    svg_.text(kLeft + kWidth / 2, bottom_ + 42, "horizontal distance from the release (m)", 13, Svg::Anchor::middle);
  }

 private:
  Svg& svg_;
  double bottom_, farthest_, greatest_;
};

/// A step function with one step for each cell of distance.
std::vector<std::array<double, 2>> stepsOf(const Panel& panel, const MergedRuns& merged, double cellM,
                                           const std::function<double(const CellSummary&)>& value) {
  std::vector<std::array<double, 2>> points;
  for (const auto& [cell, summary] : merged.distances) {
    const double height = panel.y(value(summary));
    points.push_back({panel.x(cell * cellM), height});
    points.push_back({panel.x((cell + 1) * cellM), height});
  }
  return points;
}

void drawQuantity(Svg& svg, double top, const Drawn& quantity, const MergedRuns& merged, double cellM, double farthest,
                  bool isLast) {
  double greatest = 0;
  for (const auto& [cell, summary] : merged.distances)
    greatest = std::max(greatest, quantity.of(summary).greatest() / quantity.unit);
  Panel panel(svg, top, farthest, greatest, quantity.label);
  for (const Curve& curve : kCurves)
    svg.polyline(stepsOf(panel, merged, cellM,
                         [&](const CellSummary& c) { return valueOf(quantity.of(c), curve) / quantity.unit; }),
                 curve.style);
  if (isLast) panel.drawDistances();
}

void drawCount(Svg& svg, double top, const MergedRuns& merged, double cellM, double farthest) {
  Panel panel(svg, top, farthest, static_cast<double>(merged.rocks), "rocks that came so far");
  svg.polyline(stepsOf(panel, merged, cellM, [](const CellSummary& c) { return static_cast<double>(c.passages()); }),
               "stroke:#444;stroke-width:1.6");
  panel.drawDistances();
}

void drawLegend(Svg& svg) {
  double x = kLeft + kWidth - 300;
  for (const Curve& curve : kCurves) {
    svg.line(x, 40, x + 24, 40, curve.style);
    svg.text(x + 30, 44, curve.name, 12);
    x += 110;
  }
}

}  // namespace

std::string profileFigure(const Case& description, const MergedRuns& merged, double cellM) {
  const double farthest = (merged.distances.rbegin()->first + 1) * cellM;
  Svg svg(kLeft + kWidth + kRight, kTop + 3 * kPanel + 2 * kGap + kBottom);
  svg.text(kLeft, 24, fmt::format("{}: {} rocks in {} runs", description.name, merged.rocks, merged.runs), 16);
  drawLegend(svg);
  const Drawn energy{"kinetic energy (kJ)", 1000,
                     [](const CellSummary& c) -> const LogHistogram& { return c.of(Quantity::energy); }};
  const Drawn height{"centre above ground (m)", 1,
                     [](const CellSummary& c) -> const LogHistogram& { return c.of(Quantity::height); }};
  drawQuantity(svg, kTop, energy, merged, cellM, farthest, false);
  drawQuantity(svg, kTop + kPanel + kGap, height, merged, cellM, farthest, false);
  drawCount(svg, kTop + 2 * (kPanel + kGap), merged, cellM, farthest);
  return std::move(svg).finish();
}

}  // namespace cairn::rockfall
