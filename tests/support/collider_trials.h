// SPDX-License-Identifier: Zlib
#pragma once

#include <cmath>
#include <numbers>

#include "collider_shapes.h"

namespace cairn::test {

/// The three things a body does on a ground, and what mechanics says of them.
struct Trials {
  static constexpr double kGravity = 9.81;
  static constexpr double kSlideDegrees = 30, kSlideFriction = 0.3, kRollDegrees = 10;
  static constexpr int kRestSeconds = 3;

  static Slope slopeOf(const TriedGround& ground, const TriedMover& mover, double degrees, double friction,
                       bool bodyFirst) {
    Slope slope{.degrees = degrees,
                .friction = btScalar(friction),
                .ground = ground.shape,
                .top = ground.top,
                .height = mover.height,
                // The middle of what bends stays where it is set down.
                .uphill = ground.bend > 0 || degrees == 0 ? btScalar(0) : btScalar(3),
                .turned = mover.turned,
                .radius = mover.radius};
    slope.groundTurned = ground.turned;
    slope.bodyFirst = bodyFirst;
    return slope;
  }

  /// By how much what is level lies lower on a tree, or a tree on it, than Bullet's shapes do: see
  /// `TriedGround::margin`.
  static double restTheory(const TriedGround& ground, const TriedMover& mover) {
    return -double(ground.margin + mover.meshMargin);
  }
  static RestRun rest(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
    return runRest(mover.body, slopeOf(ground, mover, 0, 0.5, bodyFirst), kRestSeconds);
  }
  static SlopeRun slide(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
    return runSlope(mover.body, slopeOf(ground, mover, kSlideDegrees, kSlideFriction, bodyFirst));
  }
  static SlopeRun roll(const TriedGround& ground, const TriedMover& mover, bool bodyFirst) {
    return runSlope(mover.body, slopeOf(ground, mover, kRollDegrees, 1, bodyFirst));
  }

  /// The measure of `slide` for a body without extent: on what bends away it goes ever steeper and weighs ever less.
  static double slideTheory(const TriedGround& ground, const TriedMover& mover) {
    return meanAcceleration(ground, mover, kSlideDegrees, [](double angle, double centripetal) {
      return kGravity * std::sin(angle) - kSlideFriction * (kGravity * std::cos(angle) - centripetal);
    });
  }
  static double rollTheory(const TriedGround& ground, const TriedMover& mover) {
    const double turning = double(mover.body.inertia[1]) / (mover.radius * mover.radius);
    return meanAcceleration(ground, mover, kRollDegrees,
                            [&](double angle, double) { return kGravity * std::sin(angle) / (1 + turning); });
  }

  /// By how much less than a ball's `rollTheory` what has facets accelerates if each of them strikes the ground without
  /// bouncing: the point it turns about moves on by a facet, and what moved towards that is lost.
  static double facetLoss(const TriedMover& mover, double theory) {
    if (mover.facets == 0) return 0;
    const double inertia = double(mover.body.inertia[1]) / (mover.radius * mover.radius);
    const double kept = (inertia + std::cos(2 * std::numbers::pi / mover.facets)) / (inertia + 1);
    const double facet = 2 * std::numbers::pi * mover.radius / mover.facets;
    const Slope times;
    const double from = theory * times.fromStep / kStepsPerSecond, to = theory * times.toStep / kStepsPerSecond;
    const double meanSpeedSq = (from * from + from * to + to * to) / 3;
    return (1 - kept * kept) * meanSpeedSq / (2 * facet);
  }

 private:
  // Along the slope as it is where the body starts, between the times of a `Slope`.
  static double meanAcceleration(const TriedGround& ground, const TriedMover& mover, double degrees,
                                 const auto& acceleration) {
    const Slope times;
    constexpr int kFiner = 16;  // the solver's steps halved four times: an error of a thousandth
    const double step = 1.0 / (kStepsPerSecond * kFiner), start = degrees * std::numbers::pi / 180;
    const double radius = ground.bend > 0 ? ground.bend + double(mover.height) : 0;
    double speed = 0, way = 0, before = 0;
    for (int i = 0; i < times.toStep * kFiner; ++i) {
      if (i == times.fromStep * kFiner) before = speed * std::cos(radius > 0 ? way / radius : 0);
      const double turned = radius > 0 ? way / radius : 0;
      speed += acceleration(start + turned, radius > 0 ? speed * speed / radius : 0) * step;
      way += speed * step;
    }
    const double after = speed * std::cos(radius > 0 ? way / radius : 0);
    return (after - before) * kStepsPerSecond / (times.toStep - times.fromStep);
  }
};

}  // namespace cairn::test
