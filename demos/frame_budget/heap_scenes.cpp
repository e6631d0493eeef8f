// SPDX-License-Identifier: GPL-3.0-or-later
#include "heap_scenes.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "outputs.h"
#include "scenes/command/program.h"
#include "scenes/figures/bare_deadline.h"
#include "scenes/pictures/heap_picture.h"
#include "scenes/pictures/povray.h"
#include "scenes/rockfall/rockfall.h"

namespace cairn::frame_budget {
namespace {

Result<std::unique_ptr<scenes::BodyScene>> makeScene(const scenes::HeapOptions& options, Scene scene,
                                                     const scenes::Model& model) {
  if (scene == Scene::rockfall) {
    auto rockfall = scenes::Rockfall::create(
        model, {options.bodies, options.seed, options.stepsWithoutBudget, options.world, options.shape});
    if (!rockfall) return rockfall.error();
    return Result<std::unique_ptr<scenes::BodyScene>>(std::move(rockfall).value());
  }
  auto heap = scenes::Heap::create(model, options);
  if (!heap) return heap.error();
  return Result<std::unique_ptr<scenes::BodyScene>>(std::move(heap).value());
}

/// Judges contacts between bodies at the poses at which they were made.
Result<scenes::ContactAccuracy> judge(const scenes::BodyScene& scene, std::span<const scenes::BodyMotion> motions,
                                      const scenes::StepRecord& record) {
  const scenes::Model& model = scene.model();
  const auto surface = scenes::ExactSurface::create(model.vertices, model.triangles);
  if (!surface) return surface.error();
  std::vector<scenes::ReportedContact> contacts = scene.world().contacts();
  std::erase_if(contacts, [](const auto& contact) { return contact.first < 0 || contact.second < 0; });
  scenes::FrameTruth truth(surface.value(), model, motions);
  scenes::AccuracyJudge judge(model.size);
  judge.judge(truth, contacts, record);
  return judge.result();
}

// One loop for each step, but at most a second in total.
std::optional<double> bareDeadline(double microseconds, std::uint32_t steps) {
  constexpr double kMaxMicroseconds = 1e6;
  if (!(microseconds <= kMaxMicroseconds)) return {};
  const double loops = std::min(kMaxMicroseconds / std::max(microseconds, 1.0), static_cast<double>(steps));
  return scenes::bareDeadline(microseconds, static_cast<std::uint32_t>(loops)).p999;
}

Status drawPicture(const Options& options, const scenes::BodyScene& scene) {
  return scenes::renderWithPovray(scenes::heapPicture(static_cast<const scenes::Heap&>(scene)), {}, *options.picture);
}

}  // namespace

Result<std::optional<scenes::CrushStart>> startOf(const Options& options, const scenes::Model& model) {
  if (options.scene != Scene::crush) return std::optional<scenes::CrushStart>();
  auto made = scenes::crushStart(model, options.heap.bodies, options.heap.seed);
  if (!made) return made.error();
  return std::optional(std::move(made).value());
}

Result<HeapRun> runShape(const Options& options, const scenes::Model& model, const scenes::CrushStart* start,
                         scenes::ShapeKind shape, const ShapeExtras& extras) {
  scenes::HeapOptions heapOptions = options.heap;
  heapOptions.world.shape = shape;
  HeapRun run{shape, {}, {}};
  if (start) {
    heapOptions.start = start->poses;
    const auto emptyStep = scenes::measureEmptyStep(model, heapOptions);
    if (!emptyStep) return emptyStep.error();
    run.course = scenes::CrushCourse();
    run.course->emptyStepCpuUs = emptyStep.value();
    if (const auto& budget = heapOptions.world.budget.microseconds; budget && scenes::isSphereTree(shape))
      run.course->bareDeadlineCpuUs = bareDeadline(*budget, options.steps);
  }
  auto made = makeScene(heapOptions, options.scene, model);
  if (!made) return made.error();
  scenes::BodyScene& scene = *made.value();
  scenes::ProgressLine progress(extras.title.empty() ? scenes::shapeName(shape) : extras.title);
  std::vector<scenes::BodyMotion> beforeLast = scene.world().motions();
  const auto show = [&](std::uint32_t done) {
    if (extras.judged && done + 1 == options.steps) beforeLast = scene.world().motions();
    return progress.show("steps", static_cast<double>(done) / options.steps);
  };
  auto report =
      start ? scenes::runCrush(scene, options.steps, *run.course, show) : scenes::runHeap(scene, options.steps, show);
  if (!report) return report.error();
  run.report = std::move(report).value();
  if (extras.judged) {
    auto accuracy = judge(scene, beforeLast, run.report.records.back());
    if (!accuracy) return accuracy.error();
    run.accuracy = std::move(accuracy).value();
  }
  if (extras.picture)
    if (const Status drawn = drawPicture(options, scene); !drawn) return drawn.error();
  return run;
}

Status measureHeaps(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model) {
  const auto start = startOf(options, model);
  if (!start) return start.error();
  const scenes::CrushStart* const startOrNone = start.value() ? &*start.value() : nullptr;
  std::vector<HeapRun> runs;
  for (const scenes::ShapeKind shape : options.shapes) {
    auto run = runShape(options, model, startOrNone, shape, {.picture = options.picture && runs.empty()});
    if (!run) return run.error();
    runs.push_back(std::move(run).value());
  }
  printHeapTable(options, source, startOrNone, runs);
  std::vector<nlohmann::ordered_json> objects;
  std::vector<LoggedRun> logged;
  for (const HeapRun& run : runs) {
    objects.push_back(toJson(options, source, startOrNone, run));
    logged.push_back({run.shape, run.report.records});
  }
  return writeOutputs(options, objects, logged);
}

}  // namespace cairn::frame_budget
