// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bound/cover_refutation.h"
#include "bound/surface_spread.h"
#include "cairn/builder/bound.h"

namespace cairn::builder {
namespace {

constexpr std::uint32_t kMinPoints = 8, kMaxPoints = 20'000;
constexpr std::uint32_t kMaxSpheres = 100'000;

/// Errors tried are 2^(-step / kStepsPerOctave) of the diagonal, for steps in [0, kLastStep].
constexpr int kStepsPerOctave = 64;
constexpr int kLastStep = 12 * kStepsPerOctave;
/// With many spheres the search ends when the proved and the unproved step differ by this number. The bound is weak
/// there, and attempts near its limit cost most.
constexpr int kCoarseSteps = 8;
/// First stride of the search, and its start, where few balls usually fail.
constexpr int kFirstStride = 16;

std::uint32_t pointsFor(std::uint32_t spheres) {
  return std::min<std::uint32_t>(1500 + 25 * spheres, 4000);
}

int firstStep(std::uint32_t spheres) {
  const double fraction = 0.4 * std::pow(spheres, -0.7);
  return std::clamp(static_cast<int>(-kStepsPerOctave * std::log2(fraction)), 0, kLastStep);
}

/// Finds the smallest step (largest error) that can be proved. It strides from the first guess until one step is proved
/// and another is not, then halves the interval.
class StepSearch {
 public:
  StepSearch(CoverRefuter& refuter, std::uint32_t spheres, double diagonal, const ProgressCallback& progress)
      : refuter_(refuter), spheres_(spheres), diagonal_(diagonal), progress_(progress) {}

  double errorAt(int step) const { return diagonal_ * std::exp2(-static_cast<double>(step) / kStepsPerOctave); }

  /// Returns the proof and its step, if any; ends early when cancelled.
  std::optional<Refutation> run(int& provedStep) {
    int failed = -1, proved = kLastStep + 1;
    int stride = kFirstStride;
    const int closeEnough = spheres_ <= kFewSpheres ? 1 : kCoarseSteps;
    const auto isDecided = [&] {
      const bool bracketed = failed >= 0 && proved <= kLastStep;
      return proved - failed <= (bracketed ? closeEnough : 1);
    };
    for (int step = firstStep(spheres_); !cancelled_ && !isDecided();) {
      if (std::optional<Refutation> proof = attempt(step)) {
        best_ = std::move(proof);
        proved = step;
      } else {
        failed = step;
      }
      if (failed < 0) {
        step = std::max(0, proved - stride);
        stride *= 2;
      } else if (proved > kLastStep) {
        step = std::min(kLastStep, failed + stride);
        stride *= 2;
      } else {
        step = (failed + proved) / 2;
      }
    }
    provedStep = proved;
    return std::move(best_);
  }

  bool cancelled() const { return cancelled_; }

 private:
  std::optional<Refutation> attempt(int step) {
    // The number of attempts is unknown, so the reported share approaches one without a final jump.
    const double share = 1 - std::pow(0.8, attempts_++);
    return refuter_.refute(spheres_, errorAt(step), [&] {
      cancelled_ = cancelled_ || (progress_ && !progress_("bounding", share));
      return !cancelled_;
    });
  }

  CoverRefuter& refuter_;
  std::uint32_t spheres_;
  double diagonal_;
  const ProgressCallback& progress_;
  std::optional<Refutation> best_;
  int attempts_ = 0;
  bool cancelled_ = false;
};

Status checkOptions(std::uint32_t spheres, const BoundOptions& options) {
  if (spheres < 1 || spheres > kMaxSpheres)
    return Error{fmt::format("{} spheres cannot be bounded; ask for 1 to {}", spheres, kMaxSpheres)};
  if (options.points != 0 && (options.points < kMinPoints || options.points > kMaxPoints))
    return Error{fmt::format("{} points are out of range; choose {} to {}, or 0 to have them chosen", options.points,
                             kMinPoints, kMaxPoints)};
  return {};
}

}  // namespace

Result<ErrorBound> lowerErrorBound(const TriangleMesh& mesh, std::uint32_t spheres, const BoundOptions& options,
                                   const ProgressCallback& progress) {
  if (Status s = checkOptions(spheres, options); !s) return s.error();
  const SignedDistance solid(mesh);
  const std::vector<Vec3d> points = spreadOverSurface(mesh, options.points != 0 ? options.points : pointsFor(spheres));
  CoverRefuter refuter(solid, points);
  StepSearch steps(refuter, spheres, solid.bounds().diagonal(), progress);
  int step = 0;
  const std::optional<Refutation> proof = steps.run(step);
  if (steps.cancelled()) return Error{std::string(kCancelled)};
  ErrorBound bound;
  bound.spheres = spheres;
  if (!proof) return bound;
  bound.error = steps.errorAt(step);
  bound.mostInOneBall = proof->mostInOneBall;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (proof->weights[i] > 0) bound.weights.push_back({points[i], proof->weights[i]});
  }
  return bound;
}

}  // namespace cairn::builder
