// SPDX-License-Identifier: GPL-3.0-or-later
#include "bound/step_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cairn::builder {
namespace {

/// Errors tried are 2^(-step / kStepsPerOctave) of the diagonal, for steps in [0, kLastStep].
constexpr int kStepsPerOctave = 64;
constexpr int kLastStep = 12 * kStepsPerOctave;
/// First stride of the search where nothing is proved yet, from a low beginning or not, and where fewer points have
/// proved a step.
constexpr int kLowStride = 32, kFirstStride = 16, kLaterStride = 4;

/// Where few balls usually fail, or a third of that error: a proof far below the limit is found at once, while a
/// failure costs all rounds.
int firstStep(std::uint32_t spheres, bool isLow) {
  const double fraction = (isLow ? 0.13 : 0.4) * std::pow(spheres, -0.7);
  return std::clamp(static_cast<int>(-kStepsPerOctave * std::log2(fraction)), 0, kLastStep);
}

}  // namespace

double StepSearch::errorAt(int step) const {
  return diagonal_ * std::exp2(-static_cast<double>(step) / kStepsPerOctave);
}

void StepSearch::run(const StepStage& stage) {
  int failed = -1, proved = proved_ >= 0 ? proved_ : kLastStep + 1;
  int stride = proved_ >= 0 ? kLaterStride : stage.beginsLow ? kLowStride : kFirstStride;
  const auto isDecided = [&] {
    const bool bracketed = failed >= 0 && proved <= kLastStep;
    return proved - failed <= (bracketed ? stage.closeEnough : 1);
  };
  double left = 1;  // the number of attempts is unknown, so the share approaches the end without a final jump
  int step = proved_ >= 0 ? std::max(0, proved - stride) : firstStep(spheres_, stage.beginsLow);
  while (!isDecided()) {
    watch_.enter(proved_ >= 0 ? fmt::format("bounding, {:.4f} % proved", 100 * best_.error / diagonal_) : "bounding",
                 stage.to - (stage.to - stage.from) * left);
    if (!watch_.goesOn()) return;
    left *= 0.8;
    (prove(step, stage) ? proved : failed) = step;
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
}

bool StepSearch::prove(int step, const StepStage& stage) {
  const std::vector<Vec3d>& points = stage.points;
  const std::optional<Refutation> proof = refuter_.refute(points, spheres_, errorAt(step), stage.effort);
  if (!proof) return false;
  proved_ = step;
  best_.error = errorAt(step);
  best_.mostInOneBall = proof->mostInOneBall;
  best_.weights.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (proof->weights[i] > 0) best_.weights.push_back({points[i], proof->weights[i]});
  }
  return true;
}

}  // namespace cairn::builder
