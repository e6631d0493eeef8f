// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/volume_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "balls/enclosing_ball.h"
#include "flat/excess.h"
#include "levels/level_field.h"
#include "surface/infinity.h"

namespace cairn::builder {
namespace {

/// Samples of the layer, and its height in parts of the worst stand-off: balls may stick out that much farther than
/// needed if that wastes less.
constexpr std::size_t kSamples = 60'000, kSamplesPerBall = 200, kQuickSamplesPart = 4;
constexpr double kReach = 2;
/// Points of the surface for each ball, at least.
constexpr std::size_t kSurfacePerBall = 60, kMinSurface = 1500;
/// Sweeps over all balls; each ends the search when it saves less than a part.
constexpr int kSweeps = 12;
constexpr double kWorthASweep = 0.003;
/// First step of a centre, in parts of the stand-off.
constexpr double kStep = 0.3;
/// Balls set down anew, in parts of all, and of how many of the most dispensable and most wasteful the best are taken.
constexpr double kMovesPerBall = 1;
constexpr std::size_t kFewMoves = 8;

/// Radii with which each ball holds the points it holds most cheaply.
SphereSet holding(SphereSet balls, const PointSet& points) {
  std::vector<double> costs(points.size()), least(points.size(), kInfinity);
  std::vector<std::size_t> owner(points.size(), 0);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    points.distances(balls[i].center, balls[i].depth, costs);
    for (std::size_t p = 0; p < costs.size(); ++p)
      if (costs[p] < least[p]) least[p] = costs[p], owner[p] = i;
  }
  for (Ball& ball : balls) ball.radius = 0;
  for (std::size_t p = 0; p < costs.size(); ++p) {
    Ball& ball = balls[owner[p]];
    ball.radius = std::max(ball.radius, distance(ball.center, points[p]));
  }
  return balls;
}

using Names = std::vector<std::uint32_t>;

class VolumeSearch {
 public:
  VolumeSearch(const FlatProblem& problem, Excess excess, double standOff)
      : problem_(problem), excess_(std::move(excess)), standOff_(standOff) {}

  SphereSet run() {
    sweepAll();
    const auto moves =
        kFewMoves + static_cast<std::size_t>(kMovesPerBall * static_cast<double>(excess_.balls().size()));
    for (std::size_t n = 0; n < moves && problem_.keepGoing() && moveOne(); ++n) {
    }
    sweepAll();
    SphereSet balls = excess_.balls();
    std::erase_if(balls, [](const Ball& ball) { return !(ball.radius > 0); });
    return balls;
  }

 private:
  void sweepAll() {
    double step = kStep * standOff_;
    for (int sweep = 0; sweep < kSweeps && problem_.keepGoing(); ++sweep) {
      const std::size_t before = excess_.total();
      for (std::uint32_t i = 0; i < excess_.balls().size() && problem_.keepGoing(); ++i) improve(i, step);
      if (static_cast<double>(excess_.total()) > (1 - kWorthASweep) * static_cast<double>(before)) break;
      step *= 0.9;
    }
  }

  void improve(std::uint32_t i, double step) {
    const Names duties = excess_.dutiesOf(i);
    Ball ball = excess_.balls()[i];
    if (duties.empty())
      ball.radius = 0;
    else
      ball = excess_.fit(duties, ball.center, step, i).ball;
    excess_.replace(i, ball);
  }

  /// By ball: the radius it would need to take its share of the points of ball `i`.
  std::vector<double> grown(std::uint32_t i) const {
    const SphereSet& balls = excess_.balls();
    std::vector<double> radii(balls.size());
    std::transform(balls.begin(), balls.end(), radii.begin(), [](const Ball& ball) { return ball.radius; });
    for (const std::uint32_t p : excess_.dutiesOf(i)) {
      const Vec3d point = excess_.surface()[p];
      std::size_t heir = i;
      double least = kInfinity;
      for (std::size_t k = 0; k < balls.size(); ++k) {
        const double more = distance(point, balls[k].center) - radii[k];
        if (k != i && more < least) least = more, heir = k;
      }
      if (heir != i) radii[heir] = std::max(radii[heir], radii[heir] + least);
    }
    return radii;
  }

  /// What taking a ball away would cost, estimated by the volumes its heirs grow by.
  double priceOf(std::uint32_t i) const {
    const std::vector<double> radii = grown(i);
    double volume = -std::pow(excess_.balls()[i].radius, 3);
    for (std::size_t k = 0; k < radii.size(); ++k)
      volume += std::pow(radii[k], 3) - std::pow(excess_.balls()[k].radius, 3);
    return volume;
  }

  /// All balls, those of the lowest figure first.
  Names lowestFirst(const std::vector<double>& figures) const {
    Names order(figures.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return figures[a] < figures[b]; });
    return order;
  }

  /// Sets one of the most dispensable balls down beside one of the most wasteful, and keeps that if it gains.
  bool moveOne() {
    std::vector<double> prices, gains;
    for (std::uint32_t i = 0; i < excess_.balls().size(); ++i) {
      prices.push_back(priceOf(i));
      gains.push_back(-static_cast<double>(excess_.own(i)));
    }
    const Names cheap = lowestFirst(prices), wasteful = lowestFirst(gains);
    for (std::size_t n = 0; n < std::min(kFewMoves, cheap.size()) && problem_.keepGoing(); ++n) {
      // The cheapest with the worst first; then the next of either.
      const std::uint32_t from = cheap[n / 2], to = wasteful[(n + 1) / 2];
      if (from == to) continue;
      const Excess before = excess_;
      relocate(from, to);
      if (excess_.total() < before.total()) return true;
      excess_ = before;
    }
    return false;
  }

  void relocate(std::uint32_t from, std::uint32_t to) {
    const std::vector<double> radii = grown(from);
    Names touched{from, to};
    for (std::uint32_t k = 0; k < radii.size(); ++k) {
      Ball ball = excess_.balls()[k];
      if (!(radii[k] > ball.radius) || k == from) continue;
      ball.radius = radii[k] * (1 + 1e-9);
      excess_.replace(k, ball);
      touched.push_back(k);
    }
    Ball gone = excess_.balls()[from];
    gone.radius = 0;
    excess_.replace(from, gone);
    halve(to, from);
    for (int round = 0; round < 2; ++round)
      for (const std::uint32_t k : touched) improve(k, kStep * standOff_);
  }

  /// Divides the points of ball `whole` between it and ball `other`: by which of two far ones is nearer.
  void halve(std::uint32_t whole, std::uint32_t other) {
    const Names duties = excess_.dutiesOf(whole);
    if (duties.size() < 2) return;
    PointSet points;
    points.assign(excess_.surface(), duties);
    const Vec3d a = points[points.farthest(points[0]).index], b = points[points.farthest(a).index];
    std::array<std::vector<Vec3d>, 2> halves;
    for (std::size_t k = 0; k < points.size(); ++k)
      halves[lengthSq(points[k] - a) < lengthSq(points[k] - b) ? 0 : 1].push_back(points[k]);
    if (halves[0].empty() || halves[1].empty()) return;
    const EnclosingBall first = smallestEnclosingBall(halves[0]), second = smallestEnclosingBall(halves[1]);
    excess_.replace(other, {second.center, second.radius * (1 + 1e-9), 0});
    excess_.replace(whole, {first.center, first.radius * (1 + 1e-9), 0});
  }

  const FlatProblem& problem_;
  Excess excess_;
  double standOff_;
};

}  // namespace

SphereSet leastExcess(const FlatProblem& problem, const FlatPoints& points, SphereSet start) {
  const std::size_t count = start.size();
  const PointSet surface = evenSample(points.points, std::max(kMinSurface, kSurfacePerBall * count), 0);
  const double standOff = std::max(coverStandOff(surface, start), problem.negligible);
  const std::unique_ptr<DepthField> field = fieldNear(problem.solid, standOff);
  const std::size_t samples = (kSamples + kSamplesPerBall * count) / (problem.quick ? kQuickSamplesPart : 1);
  const PointSet outside = outsideSamples(problem.solid, kReach * standOff, samples, problem.seed);
  Excess excess(surface, outside, *field, kReach * standOff, holding(std::move(start), surface));
  return VolumeSearch(problem, std::move(excess), standOff).run();
}

}  // namespace cairn::builder
