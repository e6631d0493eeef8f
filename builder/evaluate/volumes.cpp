// SPDX-License-Identifier: GPL-3.0-or-later
//
// The only file that includes the GNU Scientific Library.
#include "evaluate/volumes.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_monte_miser.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "surface/random_stream.h"

namespace cairn::builder {
namespace {

constexpr std::size_t kLines = 100'000;
constexpr std::uint32_t kDepthLinesPerSide = 141;  // 19 881 lines

double totalLength(const LineParts& parts) {
  double sum = 0;
  for (const LinePart& part : parts) sum += part.end - part.begin;
  return sum;
}

/// The integrand: the length of `from` without `what` along one line.
struct Difference {
  const SolidLines& solid;
  const BallLines& balls;
  bool wasted;  // balls without the solid, else the solid without the balls
  LineParts ofSolid, ofBalls, left;

  double lengthAt(double x, double y) {
    if (wasted) {
      balls.partsAt(x, y, ofBalls);
      if (ofBalls.empty()) return 0;
      solid.partsAt(x, y, ofSolid);
      subtract(ofBalls, ofSolid, left);
    } else {
      solid.partsAt(x, y, ofSolid);
      if (ofSolid.empty()) return 0;
      balls.partsAt(x, y, ofBalls);
      subtract(ofSolid, ofBalls, left);
    }
    return totalLength(left);
  }
};

double integrand(double* point, std::size_t, void* difference) {
  return static_cast<Difference*>(difference)->lengthAt(point[0], point[1]);
}

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

/// Returns the integral of a difference over the plane; the difference is 0 outside `bounds`.
VolumeEstimate integrated(Difference difference, const Rectangle& bounds, std::uint64_t seed) {
  constexpr std::size_t kDimensions = 2;
  const Owned<gsl_rng> random(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
  const Owned<gsl_monte_miser_state> miser(gsl_monte_miser_alloc(kDimensions), gsl_monte_miser_free);
  // Seeds of this generator have 32 bits. All 64 bits are mixed into them, so that similar seeds differ.
  gsl_rng_set(random.get(), static_cast<unsigned long>(RandomStream(seed, 0).uniform() * 0x1p32));
  std::array<double, kDimensions> lower = bounds.lower, upper = bounds.upper;
  gsl_monte_function function{&integrand, kDimensions, &difference};
  VolumeEstimate estimate;
  [[maybe_unused]] const int status =
      gsl_monte_miser_integrate(&function, lower.data(), upper.data(), kDimensions, kLines, random.get(), miser.get(),
                                &estimate.value, &estimate.standardError);
  assert(status == GSL_SUCCESS);  // it fails only for an empty box, and a solid has an extent
  return estimate;
}

}  // namespace

VolumeEstimate wastedVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed) {
  return integrated({solid, balls, true, {}, {}, {}}, balls.bounds(), seed);
}

VolumeEstimate uncoveredVolume(const SolidLines& solid, const BallLines& balls, std::uint64_t seed) {
  return integrated({solid, balls, false, {}, {}, {}}, solid.bounds(), seed);
}

UncoveredDepth uncoveredDepth(const SignedDistance& distance, const SolidLines& solid, const BallLines& balls,
                              std::uint64_t seed) {
  const Rectangle& bounds = solid.bounds();
  RandomStream random(seed, 1);
  LineParts ofSolid, ofBalls, uncovered;
  UncoveredDepth depth;
  double weightedSq = 0, lengths = 0;
  const auto coordinate = [&](int axis, std::uint32_t cell) {
    const double share = (cell + random.uniform()) / kDepthLinesPerSide;
    return bounds.lower[axis] + share * (bounds.upper[axis] - bounds.lower[axis]);
  };
  for (std::uint32_t i = 0; i < kDepthLinesPerSide * kDepthLinesPerSide; ++i) {
    const double x = coordinate(0, i % kDepthLinesPerSide), y = coordinate(1, i / kDepthLinesPerSide);
    solid.partsAt(x, y, ofSolid);
    balls.partsAt(x, y, ofBalls);
    subtract(ofSolid, ofBalls, uncovered);
    for (const LinePart& part : uncovered) {
      const double partLength = part.end - part.begin;
      const double here = std::max(0.0, distance.depth({x, y, part.begin + random.uniform() * partLength}));
      depth.max = std::max(depth.max, here);
      weightedSq += partLength * here * here;
      lengths += partLength;
    }
  }
  if (lengths > 0) depth.rms = std::sqrt(weightedSq / lengths);
  return depth;
}

}  // namespace cairn::builder
