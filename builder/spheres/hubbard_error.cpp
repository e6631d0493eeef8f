// SPDX-License-Identifier: GPL-3.0-or-later
#include "spheres/hubbard_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "balls/ritter_ball.h"

namespace cairn::builder {

namespace {

/// Points nearer to a centre than this fraction of the radius stay in the ball while it grows, because each ball holds
/// its predecessors up to rounding.
constexpr double kSurelyInside = 1 - 1e-9;
/// Approximate number of points of each set that a bound examines.
constexpr std::size_t kBoundPoints = 24;

}  // namespace

SampleSet::SampleSet(std::span<const std::uint32_t> samples, const HubbardMedial& medial)
    : samples_(samples.begin(), samples.end()) {
  assert(!samples.empty());
  for (const std::uint32_t s : samples) points_.push_back(medial.samples[s].point);
  findExtremes();
}

SampleSet::SampleSet(const SampleSet& a, const SampleSet& b) {
  samples_.reserve(a.size() + b.size());
  points_.reserve(a.size() + b.size());
  for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
    const bool fromA = k == b.size() || (i < a.size() && a.samples_[i] <= b.samples_[k]);
    if (fromA && k < b.size() && a.samples_[i] == b.samples_[k]) ++k;
    samples_.push_back(fromA ? a.samples_[i] : b.samples_[k]);
    points_.push_back(fromA ? a.points_[i++] : b.points_[k++]);
  }
  findExtremes();
}

void SampleSet::findExtremes() {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points_.begin(), points_.end(),
                                                 [axis](const Vec3d& p, const Vec3d& q) { return p[axis] < q[axis]; });
    extremes_.low[axis] = static_cast<std::uint32_t>(low - points_.begin());
    extremes_.high[axis] = static_cast<std::uint32_t>(high - points_.begin());
  }
}

EnclosingBall SampleSet::ritterBall() const {
  return builder::ritterBall(points_);
}

/// The ball over the longest of the three spans between extremes.
EnclosingBall SampleSet::start(const SampleSet& a, const SampleSet& b) {
  EnclosingBall ball{a.samples_[0] < b.samples_[0] ? a.points_[0] : b.points_[0], 0};
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t lowA = a.extremes_.low[axis], lowB = b.extremes_.low[axis];
    const std::uint32_t highA = a.extremes_.high[axis], highB = b.extremes_.high[axis];
    const std::pair keyLowA(a.points_[lowA][axis], a.samples_[lowA]), keyLowB(b.points_[lowB][axis], b.samples_[lowB]);
    const std::pair keyHighA(a.points_[highA][axis], a.samples_[highA]),
        keyHighB(b.points_[highB][axis], b.samples_[highB]);
    const Vec3d low = keyLowA < keyLowB ? a.points_[lowA] : b.points_[lowB];
    const Vec3d high = keyHighA > keyHighB ? a.points_[highA] : b.points_[highB];
    const double radius = 0.5 * distance(low, high);
    if (radius > ball.radius) ball = {(low + high) * 0.5, radius};
  }
  return ball;
}

std::size_t SampleSet::nextOutside(std::size_t i, const EnclosingBall& ball) const {
  const double insideSq = ball.radius * ball.radius * kSurelyInside;
  while (i < points_.size() && lengthSq(points_[i] - ball.center) <= insideSq) ++i;
  return i;
}

EnclosingBall ritterBallOfBoth(const SampleSet& a, const SampleSet& b) {
  EnclosingBall ball = SampleSet::start(a, b);
  std::size_t i = 0, k = 0;
  while (true) {
    i = a.nextOutside(i, ball);
    k = b.nextOutside(k, ball);
    if (i == a.size() && k == b.size()) return ball;
    const bool fromA = k == b.size() || (i < a.size() && a.samples_[i] <= b.samples_[k]);
    if (fromA && k < b.size() && a.samples_[i] == b.samples_[k]) ++k;
    const Vec3d& point = fromA ? a.points_[i++] : b.points_[k++];
    const double d = distance(point, ball.center);
    if (d <= ball.radius) continue;
    const double radius = 0.5 * (ball.radius + d);
    ball.center += (point - ball.center) * ((d - radius) / d);
    ball.radius = radius;
  }
}

HubbardError::HubbardError(const HubbardMedial& medial) {
  for (const ClusterSample& sample : medial.samples) {
    first_.push_back(static_cast<std::uint32_t>(normals_.size()));
    for (const std::uint32_t cluster : sample.clusters) normals_.push_back(medial.clusterNormals[cluster]);
  }
  first_.push_back(static_cast<std::uint32_t>(normals_.size()));
}

double HubbardError::ofPoint(const EnclosingBall& ball, const SampleSet& samples, std::size_t i) const {
  const Vec3d& point = samples.point(i);
  const std::uint32_t begin = first_[samples.sample(i)], end = first_[samples.sample(i) + 1];
  double highest = -std::numeric_limits<double>::infinity();
  std::uint32_t decisive = begin;
  for (std::uint32_t n = begin; n < end; ++n)
    if (const double height = dot(ball.center - point, normals_[n]); height > highest) highest = height, decisive = n;
  // For a point in the ball the stand-off grows with the height above it, so one normal decides. Rounding keeps this
  // true while the height is not negative.
  if (highest >= 0) return normalStandOff(ball.center, ball.radius, point, normals_[decisive]);
  double worst = 0;
  for (std::uint32_t n = begin; n < end; ++n)
    worst = std::max(worst, normalStandOff(ball.center, ball.radius, point, normals_[n]));
  return worst;
}

double HubbardError::raised(double worst, const EnclosingBall& ball, const SampleSet& samples, std::size_t step) const {
  for (std::size_t i = 0; i < samples.size(); i += step) worst = std::max(worst, ofPoint(ball, samples, i));
  return worst;
}

void HubbardError::markWorst(const EnclosingBall& ball, SampleSet& samples) const {
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double error = ofPoint(ball, samples, i);
    if (error <= worst) continue;
    worst = error;
    samples.setWorst(i);
  }
}

double HubbardError::of(const EnclosingBall& ball, const SampleSet& samples) const {
  return raised(0, ball, samples, 1);
}

double HubbardError::atLeast(const SampleSet& a, const SampleSet& b) const {
  const EnclosingBall ball = ritterBallOfBoth(a, b);
  const auto step = [](const SampleSet& s) { return 1 + s.size() / kBoundPoints; };
  const double worst = std::max(ofPoint(ball, a, a.worst()), ofPoint(ball, b, b.worst()));
  return raised(raised(worst, ball, a, step(a)), ball, b, step(b));
}

double normalStandOff(const Vec3d& center, double radius, const Vec3d& point, const Vec3d& normal) {
  const double height = dot(center - point, normal);
  const double besideSq = lengthSq(center - point) - height * height;
  return std::sqrt(std::max(0.0, radius * radius - besideSq)) + height;
}

}  // namespace cairn::builder
