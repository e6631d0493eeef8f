// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/mirrored_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "flat/flat_starts.h"
#include "flat/mirrored_search.h"
#include "levels/level_field.h"

namespace cairn::builder {
namespace {

/// How many numbers of balls on the plane are tried, from the fewest there can be to all.
constexpr std::size_t kTries = 5;

PointSet foldedPoints(const PointSet& points, const Mirror& mirror) {
  PointSet folded;
  for (std::size_t p = 0; p < points.size(); ++p) folded.push(mirror.folded(points[p]));
  return folded;
}

/// Numbers of balls on the plane, of the parity of `count`.
std::vector<std::size_t> numbersOnPlane(std::size_t count) {
  const std::size_t least = count % 2;
  const std::size_t stride = std::max<std::size_t>(1, (count - least) / 2 / (kTries - 1)) * 2;
  std::vector<std::size_t> numbers;
  for (std::size_t k = least; k <= count && numbers.size() < kTries; k += stride) numbers.push_back(k);
  return numbers;
}

/// A set on the folded side as pairs and balls on the plane: those nearest to it for their size.
MirroredSet divided(SphereSet balls, std::size_t onPlane, const Mirror& mirror) {
  std::stable_sort(balls.begin(), balls.end(), [&](const Ball& a, const Ball& b) {
    return std::abs(mirror.side(a.center)) * b.radius > std::abs(mirror.side(b.center)) * a.radius;
  });
  const std::size_t singles = std::min(onPlane, balls.size());
  const auto first = balls.end() - static_cast<std::ptrdiff_t>(singles);
  return {{balls.begin(), first}, {first, balls.end()}};
}

}  // namespace

FlatSet mirroredCover(const FlatProblem& problem, const FlatPoints& points, DepthOf depthOf, const Mirror& mirror) {
  const FlatPoints folded{foldedPoints(points.points, mirror), foldedPoints(points.dense, mirror)};
  FlatSet best{{}, std::numeric_limits<double>::infinity()};
  for (const std::size_t onPlane : numbersOnPlane(problem.count)) {
    const std::size_t pairs = (problem.count - onPlane) / 2;
    const FlatProblem half{problem.solid, pairs + onPlane, problem.seed, problem.negligible, true, problem.keepGoing};
    const FlatSet start = minimaxCover(half, folded, depthOf, flatStarts(half, folded));
    if (!problem.keepGoing()) return {};
    std::unique_ptr<DepthField> field = std::make_unique<SolidDepth>(problem.solid);
    const double scale = depthOf == DepthOf::closing ? 1 : 0.5;
    if (depthOf != DepthOf::solid)
      field = fieldNear(problem.solid, scale * std::max(start.standOff, problem.negligible));
    const MirroredProblem constrained{folded.points,      *field,           mirror, pairs, onPlane,
                                      problem.negligible, problem.keepGoing};
    const MirroredSet set = mirroredSearch(constrained, divided(start.balls, onPlane, mirror));
    SphereSet all = set.pairs;
    all.insert(all.end(), set.onPlane.begin(), set.onPlane.end());
    const double standOff = coverStandOff(folded.dense, all);
    if (standOff < best.standOff) best = {set.expanded(mirror), standOff, pairs};
  }
  return best;
}

SphereSet evenPairs(SphereSet balls, std::size_t pairs, const Mirror& mirror, double (*choose)(double, double)) {
  for (std::size_t i = 0; i < pairs; ++i) {
    Ball &ball = balls[2 * i], &image = balls[2 * i + 1];
    image.center = mirror.reflected(ball.center);
    ball.radius = image.radius = choose(ball.radius, image.radius);
  }
  return balls;
}

}  // namespace cairn::builder
