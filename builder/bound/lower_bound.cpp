// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bound/cover_refutation.h"
#include "bound/search_watch.h"
#include "bound/step_search.h"
#include "bound/surface_spread.h"
#include "cairn/builder/bound.h"

namespace cairn::builder {
namespace {

constexpr std::uint32_t kMinPoints = 8, kMaxPoints = 20'000;
constexpr std::uint32_t kMaxSpheres = 100'000;

/// With many spheres, and before the last stage, the search ends when the proved and the unproved step differ by this
/// number. The bound is weak there, and attempts near its limit cost most.
constexpr int kCoarseSteps = 8;
/// Points of the first stage, at least, and how many times as many the next one has. An attempt's cost grows faster
/// than its points, so the early stages together cost a small part of the last one.
constexpr std::uint32_t kFirstPoints = 60, kMorePoints = 4;
/// A search with no more points than these takes a moment, so it need not begin low.
constexpr std::uint32_t kQuickPoints = 200;

std::uint32_t pointsFor(std::uint32_t spheres) {
  return std::min<std::uint32_t>(1500 + 25 * spheres, 4000);
}

/// How many points the stages have. A proof needs more points than spheres.
std::vector<std::uint32_t> stagesFor(std::uint32_t spheres, std::uint32_t points) {
  std::vector<std::uint32_t> stages{points};
  const std::uint32_t first = std::max(kFirstPoints, 2 * spheres);
  while (stages.front() / kMorePoints >= first) stages.insert(stages.begin(), stages.front() / kMorePoints);
  return stages;
}

/// Before the last stage a weaker proof now is worth more than a better one later.
RefutationEffort earlyEffort(std::uint32_t points) {
  constexpr double kOutsideByPoint = 10;
  constexpr int kRounds = 10;
  return {std::min(kOutsideByPoint * points, RefutationEffort{}.maxOutside), kRounds};
}

Status checkOptions(std::uint32_t spheres, const BoundOptions& options) {
  if (spheres < 1 || spheres > kMaxSpheres)
    return Error{fmt::format("{} spheres cannot be bounded; ask for 1 to {}", spheres, kMaxSpheres)};
  if (options.points != 0 && (options.points < kMinPoints || options.points > kMaxPoints))
    return Error{fmt::format("{} points are out of range; choose {} to {}, or 0 to have them chosen", options.points,
                             kMinPoints, kMaxPoints)};
  if (options.seconds && !(*options.seconds > 0 && std::isfinite(*options.seconds)))
    return Error{fmt::format("{} seconds are no time to search in; choose a number above 0", *options.seconds)};
  return {};
}

}  // namespace

Result<ErrorBound> lowerErrorBound(const TriangleMesh& mesh, std::uint32_t spheres, const BoundOptions& options,
                                   const ProgressCallback& progress) {
  if (Status s = checkOptions(spheres, options); !s) return s.error();
  const std::vector<std::uint32_t> stages = stagesFor(spheres, options.points ? options.points : pointsFor(spheres));
  ErrorBound bound;
  bound.spheres = spheres;
  if (stages.back() <= spheres) return bound;  // a ball for each point holds them all, whatever the error
  SearchWatch watch(progress, options.seconds);
  const KeepGoing keepGoing = [&] { return watch.goesOn(); };
  watch.enter("bounding", 0);
  const SignedDistance solid(mesh);
  CoverRefuter refuter(solid, keepGoing);
  StepSearch search(refuter, spheres, solid.bounds().diagonal(), watch);
  for (std::size_t i = 0; i < stages.size() && keepGoing(); ++i) {
    const bool isLast = i + 1 == stages.size();
    StepStage stage;
    stage.points = spreadOverSurface(mesh, stages[i], keepGoing);
    if (!isLast) stage.effort = earlyEffort(stages[i]);
    stage.beginsLow = stages.back() > kQuickPoints;
    stage.closeEnough = isLast && spheres <= kFewSpheres ? 1 : kCoarseSteps;
    stage.from = i == 0 ? 0 : stages[i - 1] / double(stages.back());
    stage.to = stages[i] / double(stages.back());
    search.run(stage);
  }
  if (watch.cancelled()) return Error{std::string(kCancelled)};
  bound = search.best();
  bound.spheres = spheres;
  bound.stoppedByTime = watch.timeIsUp();
  return bound;
}

}  // namespace cairn::builder
