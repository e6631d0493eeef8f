// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "balls/ball_fit.h"
#include "balls/enclosing_ball.h"
#include "volumes/hull_2d.h"

namespace cairn::bench {
namespace {

using builder::SignedDistance;

// Cuts of cuts, each off by a few units of the last place: as derived in `builder::CoverProof`, with room for forty.
constexpr double kGuardShare = 0x1p-42;

/// Points, and right-handed axes to measure them along.
struct Framed {
  std::span<const Vec3d> points;
  std::array<Vec3d, 3> axes;
};

double slackAt(double radius, double away) {
  return std::sqrt(std::max(0.0, radius * radius - away * away));
}

/// Least interval such that each value is within its slack of it; a point where one is enough.
struct Interval {
  double lower = std::numeric_limits<double>::infinity(), upper = -std::numeric_limits<double>::infinity();
  void add(double value, double slack) {
    lower = std::min(lower, value + slack);
    upper = std::max(upper, value - slack);
  }
  double middle() const { return (lower + upper) / 2; }
  double half() const { return std::max(0.0, (upper - lower) / 2); }
};

/// The capsule along the first axis around the line through `through`.
SweptBall capsuleAround(const Framed& framed, const Vec3d& through) {
  const auto& [u, v, w] = framed.axes;
  const auto away = [&](const Vec3d& p) { return std::hypot(dot(p - through, v), dot(p - through, w)); };
  double radius = 0;
  for (const Vec3d& p : framed.points) radius = std::max(radius, away(p));
  Interval along;
  for (const Vec3d& p : framed.points) along.add(dot(p - through, u), slackAt(radius, away(p)));
  return {VolumeKind::capsule, through + u * along.middle(), {u, v, w}, {along.half(), 0, 0}, radius};
}

/// The slab along the first two axes, in the plane through `through`.
SweptBall slabAround(const Framed& framed, const Vec3d& through) {
  const auto& [u, v, w] = framed.axes;
  double radius = 0;
  for (const Vec3d& p : framed.points) radius = std::max(radius, std::abs(dot(p - through, w)));
  Interval x, y;
  for (const Vec3d& p : framed.points) {
    const double slack = slackAt(radius, dot(p - through, w));
    x.add(dot(p - through, u), slack);
    y.add(dot(p - through, v), slack);
  }
  SweptBall box{
      VolumeKind::slab, through + u * x.middle() + v * y.middle(), {u, v, w}, {x.half(), y.half(), 0}, radius};
  // Points off a corner are within their slack of both sides, but not of the corner: the box grows towards them.
  for (const Vec3d& p : framed.points) {
    const Vec3d off = p - box.nearestOnCore(p);
    const double aside = std::hypot(dot(off, u), dot(off, v)), slack = slackAt(radius, dot(p - through, w));
    if (aside <= slack) continue;
    for (int i = 0; i < 2; ++i) box.half[i] += std::abs(dot(off, box.axes[i])) * (1 - slack / aside);
  }
  return box;
}

std::array<Vec3d, 3> principalAxes(const SurfacePart& part) {
  Vec3d mean;
  double area = 0;
  for (const builder::Piece& piece : part) {
    mean += centroidOf(piece) * areaOf(piece);
    area += areaOf(piece);
  }
  mean = area > 0 ? mean / area : part.front().corners[0];
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const builder::Piece& piece : part)
    for (std::size_t i = 0; i < 3; ++i) {  // the middles of the edges integrate squares exactly
      const Vec3d d = (piece.corners[i] + piece.corners[(i + 1) % 3]) * 0.5 - mean;
      const Eigen::Vector3d e(d.x, d.y, d.z);
      spread += e * e.transpose() * areaOf(piece);
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const auto column = [&](int i) {
    const Eigen::Vector3d e = solver.eigenvectors().col(i);
    return normalized(Vec3d(e.x(), e.y(), e.z()));
  };
  const Vec3d u = column(2), v = normalized(column(1) - u * dot(column(1), u));
  return {u, v, cross(u, v)};
}

/// The mesh's own axes: the longest extent first, the shortest last.
std::array<Vec3d, 3> meshAxes(std::span<const Vec3d> points) {
  std::array<std::pair<double, int>, 3> extents;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax_element(
        points.begin(), points.end(), [axis](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
    extents[axis] = {(*least)[axis] - (*most)[axis], axis};
  }
  std::sort(extents.begin(), extents.end());
  Vec3d u, v;
  u[extents[0].second] = v[extents[1].second] = 1;
  return {u, v, cross(u, v)};
}

/// Turned around the last axis, so that the rectangle around the points is the smallest.
std::array<Vec3d, 3> turnedToFit(const Framed& framed) {
  const auto& [u, v, w] = framed.axes;
  std::vector<Point2> flat;
  for (const Vec3d& p : framed.points) flat.push_back({dot(p, u), dot(p, v)});
  const Point2 along = directionOfLeastRectangle(flat);
  const Vec3d turned = normalized(u * along[0] + v * along[1]);
  return {turned, cross(w, turned), w};
}

/// The box along the axes, without rounding.
SweptBall boxAround(const Framed& framed) {
  SweptBall box{VolumeKind::box, {}, framed.axes, {}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    Interval along;
    for (const Vec3d& p : framed.points) along.add(dot(p, framed.axes[i]), 0);
    box.center += framed.axes[i] * along.middle();
    box.half[i] = along.half();
  }
  return box;
}

/// The estimate looks at the core's corners and the middles between them.
Fit fitAt(const SignedDistance& solid, const SweptBall& volume) {
  double shallowest = std::numeric_limits<double>::infinity();
  const auto last = [&](int axis) { return axis < volume.dimensions() ? 1 : 0; };
  for (int x = -last(0); x <= last(0); ++x)
    for (int y = -last(1); y <= last(1); ++y)
      for (int z = -last(2); z <= last(2); ++z)
        shallowest = std::min(shallowest,
                              solid.depth(volume.onCore({x * volume.half[0], y * volume.half[1], z * volume.half[2]})));
  return {volume, volume.radius - shallowest};
}

/// Lowers the estimate of the volume that `around(center)` makes, by moves of the centre along `directions`.
template <class Around>
Fit descend(const SignedDistance& solid, const Vec3d& start, std::span<const Vec3d> directions, const Around& around) {
  constexpr double kShortest =
      0.02;  // of the first volume's reach: shorter steps gain less than certificates tell apart
  Vec3d center = start;
  Fit best = fitAt(solid, around(center));
  const double size = best.volume.reach();
  for (double step = size; step > kShortest * size; step /= 2)
    for (const Vec3d& direction : directions)
      for (const double side : {-step, step}) {
        const Vec3d moved = center + direction * side;
        const Fit trial = fitAt(solid, around(moved));
        if (trial.estimate >= best.estimate) continue;
        best = trial;
        center = moved;
      }
  return best;
}

Fit sweptFit(VolumeKind kind, const SignedDistance& solid, const Framed& framed) {
  const auto& [u, v, w] = framed.axes;
  if (kind == VolumeKind::box) return fitAt(solid, boxAround(framed));
  if (kind == VolumeKind::slab) {
    Interval height;
    for (const Vec3d& p : framed.points) height.add(dot(p, w), 0);
    const std::array<Vec3d, 1> directions{w};
    return descend(solid, w * height.middle(), directions, [&](const Vec3d& at) { return slabAround(framed, at); });
  }
  std::vector<Vec3d> flat;
  for (const Vec3d& p : framed.points) flat.push_back(p - u * dot(p, u));
  const std::array<Vec3d, 2> directions{v, w};
  return descend(solid, builder::smallestEnclosingBall(flat).center, directions,
                 [&](const Vec3d& at) { return capsuleAround(framed, at); });
}

Fit ballFit(const SignedDistance& solid, std::span<const Vec3d> points) {
  const builder::PointSet set(points);
  const builder::Ball ball = builder::fitBall(points.front(), set, builder::SolidDepth(solid));
  return {{.center = ball.center, .radius = ball.radius}, ball.standOff()};
}

}  // namespace

VolumeFit::VolumeFit(const SignedDistance& solid) : solid_(solid) {
  const builder::Bounds& bounds = solid.bounds();
  guard_ = kGuardShare * (length(bounds.lower) + length(bounds.upper));
}

std::optional<Fit> VolumeFit::operator()(VolumeKind kind, const SurfacePart& part) const {
  const std::vector<Vec3d> points = builder::cornersOf(part);
  std::optional<Fit> best;
  if (kind == VolumeKind::ball) {
    best = ballFit(solid_, points);
  } else {
    for (const std::array<Vec3d, 3>& axes : {principalAxes(part), meshAxes(points)}) {
      const Fit fit = sweptFit(kind, solid_, {points, turnedToFit({points, axes})});
      if (fit.volume.half[0] > 0 && (!best || fit.estimate < best->estimate)) best = fit;
    }
  }
  if (!best) return best;
  double radius = 0;
  for (const Vec3d& p : points) radius = std::max(radius, best->volume.distanceToCore(p));
  best->estimate += radius + guard_ - best->volume.radius;
  best->volume.radius = radius + guard_;
  return best;
}

}  // namespace cairn::bench
