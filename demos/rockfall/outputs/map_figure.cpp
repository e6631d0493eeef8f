// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "rockfall/outputs/figures.h"
#include "rockfall/outputs/svg.h"

namespace cairn::rockfall {
namespace {

constexpr double kLongSide = 1000, kMapLeft = 95, kMapTop = 50, kMapRight = 110, kMapBottom = 60;  // pixels
constexpr int kSamples = 320;             // of the relief along the longer side
constexpr int kGreys = 24, kNoGrey = -1;  // the latter over holes
constexpr std::size_t kMaxTrajectories = 400, kMaxStops = 5000;

/// From slow to fast: dark blue, violet, red, yellow.
constexpr std::array<const char*, 8> kSpeedColors{"#253494", "#41449c", "#7a3b9b", "#b5307c",
                                                  "#dd3850", "#f0632f", "#f8961e", "#f9c74f"};

/// Where the map's metres are in the picture.
struct Frame {
  Vec3d lower, upper;
  double scale, width, height;

  explicit Frame(const Ground& ground) : lower(ground.lower()), upper(ground.upper()) {
    scale = kLongSide / std::max(upper.x - lower.x, upper.y - lower.y);
    width = scale * (upper.x - lower.x);
    height = scale * (upper.y - lower.y);
  }
  double x(double metres) const { return kMapLeft + (metres - lower.x) * scale; }
  double y(double metres) const { return kMapTop + (upper.y - metres) * scale; }
};

/// Light from the upper left, as maps have it, and a little from above so that nothing is black.
double shade(const Vec3d& normal) {
  static const Vec3d kLight = normalized(Vec3d(-1, 1, 1.4));
  return std::clamp(0.25 + 0.75 * std::max(0.0, dot(normal, kLight)), 0.0, 1.0);
}

/// Rows of cells, neighbours of one grey joined, one path a grey.
void drawRelief(Svg& svg, const Frame& frame, const Ground& ground) {
  const double cell = std::max(frame.upper.x - frame.lower.x, frame.upper.y - frame.lower.y) / kSamples;
  const int columns = std::max(1, static_cast<int>(std::ceil((frame.upper.x - frame.lower.x) / cell - 1e-9)));
  const int rows = std::max(1, static_cast<int>(std::ceil((frame.upper.y - frame.lower.y) / cell - 1e-9)));
  std::array<std::string, kGreys> paths;
  const auto greyAt = [&](int column, int row) {
    const MapPoint middle{std::min(frame.lower.x + (column + 0.5) * cell, std::nextafter(frame.upper.x, frame.lower.x)),
                          std::min(frame.lower.y + (row + 0.5) * cell, std::nextafter(frame.upper.y, frame.lower.y))};
    if (!ground.covers(middle)) return kNoGrey;
    return std::min(kGreys - 1, static_cast<int>(shade(ground.normalAt(middle)) * kGreys));
  };
  const double side = cell * frame.scale;
  for (int row = 0; row < rows; ++row)
    for (int column = 0, begin = 0; column < columns; begin = column) {
      const int grey = greyAt(begin, row);
      while (column < columns && greyAt(column, row) == grey) ++column;
      if (grey == kNoGrey) continue;
      // Half a pixel over, so that no seams show.
      fmt::format_to(std::back_inserter(paths[static_cast<std::size_t>(grey)]), "M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z",
                     kMapLeft + begin * side, kMapTop + frame.height - (row + 1) * side, (column - begin) * side + 0.5,
                     side + 0.5, -(column - begin) * side - 0.5);
    }
  for (int grey = 0; grey < kGreys; ++grey) {
    const int level = 90 + 165 * grey / (kGreys - 1);
    if (const auto& path = paths[static_cast<std::size_t>(grey)]; !path.empty())
      svg.path(path, fmt::format("fill:rgb({0},{0},{1})", level, level * 97 / 100));
  }
}

/// Pieces of one colour are joined.
void drawTrajectory(Svg& svg, const Frame& frame, const Trajectory& trajectory, double fastest) {
  const auto colorOf = [&](const TrajectorySample& sample) {
    const double share = sample.speed / std::max(fastest, 1e-9) * kSpeedColors.size();
    return std::min(kSpeedColors.size() - 1, static_cast<std::size_t>(share));
  };
  const auto& samples = trajectory.samples;
  for (std::size_t i = 0; i + 1 < samples.size();) {
    const std::size_t color = colorOf(samples[i]);
    std::vector<std::array<double, 2>> points{{frame.x(samples[i].place.x), frame.y(samples[i].place.y)}};
    do {
      ++i;
      points.push_back({frame.x(samples[i].place.x), frame.y(samples[i].place.y)});
    } while (i + 1 < samples.size() && colorOf(samples[i]) == color);
    svg.polyline(points, fmt::format("stroke:{};stroke-width:1.1;stroke-opacity:0.8", kSpeedColors[color]));
  }
}

void drawLines(Svg& svg, const Frame& frame, const std::vector<Polyline>& lines, const char* color) {
  for (const std::string& style :
       {std::string("stroke:#fff;stroke-width:5"), fmt::format("stroke:{};stroke-width:2.5", color)})
    for (const Polyline& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i)
        svg.line(frame.x(line[i - 1][0]), frame.y(line[i - 1][1]), frame.x(line[i][0]), frame.y(line[i][1]), style);
}

void drawBarriers(Svg& svg, const Frame& frame, const Case& description) {
  for (const EffectOptions& effect : description.effects)
    if (const auto* barrier = std::get_if<BarrierOptions>(&effect)) drawLines(svg, frame, barrier->lines, "#222");
}

void drawCollectors(Svg& svg, const Frame& frame, const Case& description) {
  for (const Collector& collector : description.collectors) {
    drawLines(svg, frame, collector.lines, "#0a7d4f");
    MapPoint upper = collector.lines.front().front();
    for (const Polyline& line : collector.lines)
      for (const MapPoint& corner : line)
        if (corner[1] > upper[1]) upper = corner;
    svg.text(std::clamp(frame.x(upper[0]), kMapLeft, kMapLeft + frame.width), std::max(frame.y(upper[1]), kMapTop) - 6,
             collector.name, 13, Svg::Anchor::middle);
  }
}

void drawAxes(Svg& svg, const Frame& frame) {
  svg.rectangle(kMapLeft, kMapTop, frame.width, frame.height, "fill:none;stroke:#444;stroke-width:1");
  const auto stepOver = [](double span, double pixels) { return tickStep(span, std::max(3, int(pixels / 90))); };
  const double step = stepOver(frame.upper.x - frame.lower.x, frame.width);
  for (double x = std::ceil(frame.lower.x / step) * step; x <= frame.upper.x; x += step) {
    svg.line(frame.x(x), kMapTop + frame.height, frame.x(x), kMapTop + frame.height + 5, "stroke:#444");
    svg.text(frame.x(x), kMapTop + frame.height + 19, fmt::format("{:.10g}", x + 0.0), 12, Svg::Anchor::middle);
  }
  const double yStep = stepOver(frame.upper.y - frame.lower.y, frame.height);
  for (double y = std::ceil(frame.lower.y / yStep) * yStep; y <= frame.upper.y; y += yStep) {
    svg.line(kMapLeft - 5, frame.y(y), kMapLeft, frame.y(y), "stroke:#444");
    svg.text(kMapLeft - 8, frame.y(y) + 4, fmt::format("{:.10g}", y + 0.0), 12, Svg::Anchor::end);
  }
  svg.text(kMapLeft + frame.width / 2, kMapTop + frame.height + 42, "x (m)", 13, Svg::Anchor::middle);
  svg.uprightText(22, kMapTop + frame.height / 2, "y (m)", 13);
}

void drawLegend(Svg& svg, const Frame& frame, double fastest, bool hasTrajectories) {
  const double left = kMapLeft + frame.width + 18, step = 16;
  double y = kMapTop + 12;
  if (hasTrajectories) {
    svg.text(left, y, "speed (m/s)", 12);
    for (std::size_t i = kSpeedColors.size(); i-- > 0;) {
      y += step;
      svg.rectangle(left, y - 10, 14, step, fmt::format("fill:{}", kSpeedColors[i]));
      svg.text(left + 20, y + 2, fmt::format("{:.3g}", fastest * static_cast<double>(i) / kSpeedColors.size()), 11);
    }
    y += 2 * step;
  }
  svg.circle(left + 7, y, 3, "fill:#111");
  svg.text(left + 20, y + 4, "at rest", 11);
  svg.circle(left + 7, y + step, 3, "fill:#fff;stroke:#111");
  svg.text(left + 20, y + step + 4, "moving", 11);
}

}  // namespace

std::string mapFigure(const Case& description, const Ground& ground, const std::vector<Trajectory>& trajectories,
                      const std::vector<StopPoint>& stops) {
  const Frame frame(ground);
  Svg svg(kMapLeft + frame.width + kMapRight, kMapTop + std::max(frame.height, 190.0) + kMapBottom);
  svg.beginClip(kMapLeft, kMapTop, frame.width, frame.height);
  drawRelief(svg, frame, ground);
  const std::size_t drawn = std::min(trajectories.size(), kMaxTrajectories);
  double fastest = 0;
  for (std::size_t i = 0; i < drawn; ++i)
    for (const TrajectorySample& sample : trajectories[i].samples) fastest = std::max(fastest, sample.speed);
  for (std::size_t i = 0; i < drawn; ++i) drawTrajectory(svg, frame, trajectories[i], fastest);
  for (std::size_t i = 0; i < std::min(stops.size(), kMaxStops); ++i)
    svg.circle(frame.x(stops[i].place[0]), frame.y(stops[i].place[1]), 2.2,
               stops[i].ending == RockEnd::resting ? "fill:#111" : "fill:#fff;stroke:#111");
  svg.endClip();
  drawBarriers(svg, frame, description);
  drawCollectors(svg, frame, description);
  drawAxes(svg, frame);
  drawLegend(svg, frame, fastest, drawn > 0);
  svg.text(kMapLeft, 22, fmt::format("{}: trajectories and stops", description.name), 16);
  return std::move(svg).finish();
}

}  // namespace cairn::rockfall
