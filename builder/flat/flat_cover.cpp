// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat/flat_cover.h"

#include <algorithm>
#include <string>
#include <utility>

#include "flat/fewest_spheres.h"
#include "flat/fill_up.h"
#include "flat/flat_starts.h"
#include "flat/mirrored_cover.h"
#include "flat/outside_samples.h"
#include "flat/settle_radii.h"
#include "flat/volume_cover.h"

namespace cairn::builder {
namespace {

constexpr const char* kStage = "placing spheres";
/// A stand-off this small, as a part of the body's unit, is not worth lowering: no certificate shows it.
constexpr double kNegligible = 1e-6;

/// What a ball of a volume's set may grow by to hold a piece uncut, as a part of the stand-off.
constexpr double kGrowth = 0.01;
/// Where balls meet, pieces are cut down to this part of the stand-off.
constexpr double kFinestSeam = 0.004;

DepthOf depthFor(Objective objective) {
  switch (objective) {
    case Objective::balanced:
      return DepthOf::halfClosing;
    case Objective::inner:
      return DepthOf::solid;
    case Objective::outer:
    case Objective::volume:
      break;
  }
  return DepthOf::closing;
}

/// Samples that decide between two sets, and the height of the layer outside they are in, in parts of the stand-off.
constexpr std::size_t kJudges = 100'000;
constexpr double kLayer = 2.5;

std::size_t samplesIn(const SphereSet& balls, const PointSet& samples) {
  std::vector<char> held(samples.size(), 0);
  std::vector<double> distances(samples.size());
  for (const Ball& ball : balls) {
    samples.distances(ball.center, ball.radius, distances);
    for (std::size_t q = 0; q < held.size(); ++q) held[q] = held[q] != 0 || distances[q] <= 0 ? 1 : 0;
  }
  return static_cast<std::size_t>(std::count(held.begin(), held.end(), 1));
}

double larger(double a, double b) {
  return std::max(a, b);
}

double smaller(double a, double b) {
  return std::min(a, b);
}

}  // namespace

FlatCover::FlatCover(const TriangleMesh& mesh, const CoverOptions& options, const std::optional<MirrorPlane>& mirror,
                     const ProgressCallback& progress)
    : mesh_(mesh),
      options_(options),
      mirror_(mirror),
      watch_(progress),
      keepGoing_([this] { return watch_.goesOn(kStage); }),
      frame_(mesh),
      body_(bodyMesh(mesh, frame_)),
      bodySolid_(body_),
      solid_(mesh) {}

Result<Cover> FlatCover::run() {
  Result<Cover> cover = options_.spheres
                            ? make(*options_.spheres, options_.quick ? Effort::quick : Effort::full)
                            : fewestSpheres(*options_.maxError, options_.objective, mesh_.name,
                                            [this](std::uint32_t n, Effort effort) { return make(n, effort); });
  if (!watch_.report(kStage, 1)) return Error{std::string(kCancelled)};
  return cover;
}

Result<Cover> FlatCover::make(std::uint32_t count, Effort effort) {
  const FlatProblem problem{bodySolid_, count, options_.seed, kNegligible, effort == Effort::quick, keepGoing_};
  const FlatPoints points = flatPointsOf(body_, count);
  FlatSet set = search(problem, points);
  if (set.balls.empty() || !keepGoing_()) return Error{std::string(kCancelled)};
  Cover cover;
  cover.mirror = mirror_;
  cover.balls = options_.objective == Objective::volume ? leanest(set, problem, points)
                                                        : settled(outOfBody(std::move(set)), false);
  for (Ball& ball : cover.balls) ball.depth = solid_.depth(ball.center);
  Result<BallsCertificate> certificate =
      certifyBalls(cover.balls, mesh_, [this](std::string_view stage, double) { return watch_.goesOn(stage); });
  if (!certificate) return certificate.error();
  cover.certificate = std::move(certificate).value();
  return cover;
}

FlatSet FlatCover::search(const FlatProblem& problem, const FlatPoints& points) const {
  const DepthOf depthOf = depthFor(options_.objective);
  if (mirror_) return mirroredCover(problem, points, depthOf, intoBody(*mirror_, frame_));
  FlatSet set = minimaxCover(problem, points, depthOf, flatStarts(problem, points));
  if (set.balls.empty()) return set;
  set.balls = filledUp(std::move(set.balls), problem.count, points.points, bodySolid_);
  return set;
}

FlatSet FlatCover::outOfBody(FlatSet set) const {
  for (Ball& ball : set.balls) ball = frame_.outOf(ball);
  set.standOff *= frame_.unit();
  return set;
}

SphereSet FlatCover::leanest(const FlatSet& set, const FlatProblem& problem, const FlatPoints& points) const {
  FlatSet lean = set;
  lean.balls = filledUp(leastExcess(problem, points, set.balls), problem.count, points.points, bodySolid_);
  const SphereSet plain = settled(outOfBody(set), false);
  SphereSet leaner = settled(outOfBody(std::move(lean)), true);
  // Settling adds a little, which may be more than the search gained; other samples than it saw decide.
  const PointSet outside = outsideSamples(solid_, kLayer * set.standOff * frame_.unit(), kJudges, options_.seed + 1);
  return samplesIn(leaner, outside) < samplesIn(plain, outside) ? leaner : plain;
}

SphereSet FlatCover::settled(const FlatSet& set, bool keepRadii) const {
  SphereSet balls = set.balls;
  const auto even = [&](double (*choose)(double, double)) {
    if (mirror_) balls = evenPairs(std::move(balls), set.pairs, {mirror_->normal, mirror_->offset}, choose);
  };
  even(larger);  // centres first
  if (options_.objective == Objective::inner) {
    balls = innerRadii(std::move(balls), solid_);
    if (!mirror_) return balls;
    even(smaller);  // which moves images a little, where the mesh deviates from its mirror's
    balls = innerRadii(std::move(balls), solid_);
    even(smaller);
    return balls;
  }
  if (keepRadii)  // a piece goes to a ball that holds it, or very nearly
    for (Ball& ball : balls) ball.depth = ball.radius;
  balls = coveringRadii(std::move(balls), mesh_, (keepRadii ? kGrowth : 1) * set.standOff, kFinestSeam * set.standOff);
  even(larger);
  if (options_.objective != Objective::balanced) return balls;
  balls = balancedRadii(std::move(balls), solid_, keepGoing_);
  even(smaller);
  return balls;
}

}  // namespace cairn::builder
