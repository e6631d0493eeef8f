// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/excess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "surface/infinity.h"

namespace cairn::builder {
namespace {

/// Points count as held this far outside, as a part of the radius: far above rounding, far below a piece.
constexpr double kRoom = 1e-9;
/// Last step of a fit, as a part of its first.
constexpr double kFinestPart = 0.1;
/// Of two places that cost as many samples the smaller ball is taken; this much of a sample for all of a radius.
constexpr double kSmaller = 0.5;

const std::array<Vec3d, 14> kWays = [] {
  std::array<Vec3d, 14> ways{Vec3d{1, 0, 0},  Vec3d{-1, 0, 0}, Vec3d{0, 1, 0},
                             Vec3d{0, -1, 0}, Vec3d{0, 0, 1},  Vec3d{0, 0, -1}};
  for (int i = 0; i < 8; ++i)
    ways[6 + i] = normalized(Vec3d((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  return ways;
}();

std::vector<std::uint32_t> inside(const Ball& ball, const PointSet& points) {
  std::vector<double> distances(points.size());
  points.distances(ball.center, ball.radius * (1 + kRoom), distances);
  std::vector<std::uint32_t> names;
  for (std::uint32_t p = 0; p < distances.size(); ++p)
    if (distances[p] <= 0) names.push_back(p);
  return names;
}

}  // namespace

Excess::Excess(const PointSet& surface, const PointSet& outside, const DepthField& field, double reach, SphereSet balls)
    : surface_(&surface),
      outside_(&outside),
      field_(&field),
      reach_(reach),
      balls_(std::move(balls)),
      covers_(surface.size(), 0),
      wastes_(outside.size(), 0) {
  held_.resize(balls_.size());
  wasted_.resize(balls_.size());
  for (std::uint32_t i = 0; i < balls_.size(); ++i) enter(i);
}

void Excess::enter(std::uint32_t i) {
  held_[i] = inside(balls_[i], *surface_);
  wasted_[i] = inside(balls_[i], *outside_);
  for (const std::uint32_t p : held_[i]) ++covers_[p];
  for (const std::uint32_t q : wasted_[i])
    if (wastes_[q]++ == 0) ++total_;
}

void Excess::leave(std::uint32_t i) {
  for (const std::uint32_t p : held_[i]) --covers_[p];
  for (const std::uint32_t q : wasted_[i])
    if (--wastes_[q] == 0) --total_;
}

std::size_t Excess::own(std::uint32_t i) const {
  return static_cast<std::size_t>(
      std::count_if(wasted_[i].begin(), wasted_[i].end(), [&](std::uint32_t q) { return wastes_[q] == 1; }));
}

std::vector<std::uint32_t> Excess::dutiesOf(std::uint32_t i) const {
  std::vector<std::uint32_t> duties;
  std::copy_if(held_[i].begin(), held_[i].end(), std::back_inserter(duties),
               [&](std::uint32_t p) { return covers_[p] == 1; });
  return duties;
}

Excess::Fit Excess::fit(const std::vector<std::uint32_t>& points, const Vec3d& start, double coarsest,
                        std::optional<std::uint32_t> without) const {
  PointSet duties;
  duties.assign(*surface_, points);
  const double radius = duties.farthest(start).distance;
  // A centre moves at most a few of the first steps away; the radius no more.
  const double margin = 8 * coarsest, near = radius + 2 * margin;
  PointSet samples;
  samples.assign(*outside_, openSamples({start, near, 0}, without));
  std::vector<double> distances(samples.size());
  const auto costAt = [&](const Vec3d& center) {
    const double r = duties.farthest(center).distance;
    const double depth = field_->depth(center);
    // One point at the start has no radius: then nothing is smaller.
    Fit fit{{center, r * (1 + kRoom), depth}, radius > 0 ? kSmaller * r / radius : 0};
    if (r - depth > reach_ || distance(center, start) > margin) return Fit{fit.ball, kInfinity};
    samples.distances(center, fit.ball.radius, distances);
    for (const double d : distances) fit.cost += d <= 0 ? 1 : 0;
    return fit;
  };
  Fit best = costAt(start);
  for (double step = coarsest; step >= kFinestPart * coarsest; step /= 2)
    for (bool improved = true; improved;) {
      improved = false;
      for (const Vec3d& way : kWays) {
        const Fit trial = costAt(best.ball.center + way * step);
        if (!(trial.cost < best.cost - 1e-6)) continue;
        best = trial;
        improved = true;
      }
    }
  return best;
}

/// Samples in `region` that no ball holds, but the one named.
std::vector<std::uint32_t> Excess::openSamples(const Ball& region, std::optional<std::uint32_t> but) const {
  std::vector<std::uint32_t> open = inside(region, *outside_);
  std::erase_if(open, [&](std::uint32_t q) {
    return wastes_[q] > 1 ||
           (wastes_[q] == 1 && !(but && std::binary_search(wasted_[*but].begin(), wasted_[*but].end(), q)));
  });
  return open;
}

void Excess::replace(std::uint32_t i, const Ball& ball) {
  leave(i);
  balls_[i] = ball;
  enter(i);
}

}  // namespace cairn::builder
