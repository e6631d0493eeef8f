// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/crush_run.h"

#include <utility>

namespace cairn::scenes {
namespace {

constexpr double kCrushStep = 1.0 / 60;

std::optional<double> timeOfResolution(const std::vector<double>& worst) {
  std::size_t first = worst.size();
  while (first > 0 && worst[first - 1] < kResolvedFraction) --first;
  if (first == worst.size()) return {};
  return static_cast<double>(first) * kCourseInterval * kCrushStep;
}

}  // namespace

Result<HeapReport> runCrush(BodyScene& scene, std::uint32_t steps, CrushCourse& course, const StepCallback& afterStep) {
  std::vector<std::vector<btTransform>> kept{scene.world().poses()};
  auto report = runHeap(scene, steps, [&](std::uint32_t done) {
    if (done % kCourseInterval == 0) kept.push_back(scene.world().poses());
    return !afterStep || afterStep(done);
  });
  if (!report) return report.error();
  const auto surface = ExactSurface::create(scene.model().vertices, scene.model().triangles);
  if (!surface) return surface.error();
  for (const auto& poses : kept)
    course.worstPenetration.push_back(worstPenetration(surface.value(), scene.model(), poses));
  course.resolvedAfter = timeOfResolution(course.worstPenetration);
  return report;
}

Result<double> measureEmptyStep(const Model& model, const HeapOptions& options) {
  constexpr std::uint32_t kSteps = 300;
  constexpr double kHeight = 20, kSpread = 4;  // of body size
  HeapOptions empty = options;
  for (std::size_t i = 0; i < empty.start.size(); ++i)
    empty.start[i].getOrigin().setZ(static_cast<btScalar>((kHeight + kSpread * static_cast<double>(i)) * model.size));
  empty.world.gravity = 0;
  empty.world.sleeping = false;
  empty.world.budget = {.operations = 0, .microseconds = {}};
  auto heap = Heap::create(model, empty);
  if (!heap) return heap.error();
  std::vector<double> times;
  for (std::uint32_t step = 0; step < kSteps; ++step) times.push_back(heap.value()->step().narrowPhaseCpuUs);
  return quantilesOf(std::move(times)).median;
}

}  // namespace cairn::scenes
