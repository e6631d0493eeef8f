// SPDX-License-Identifier: GPL-3.0-or-later
#include "heap_scenes.h"

#include <string>
#include <utility>
#include <vector>

#include "heap_report.h"
#include "outputs.h"
#include "scenes/command/program.h"
#include "scenes/pictures/heap_picture.h"
#include "scenes/pictures/povray.h"

namespace cairn::frame_budget {
namespace {

Result<HeapRun> runShape(const Options& options, const scenes::Model& model, const scenes::CrushStart* start,
                         scenes::ShapeKind shape, bool wantsPicture) {
  scenes::HeapOptions heapOptions = options.heap;
  heapOptions.world.shape = shape;
  HeapRun run{shape, {}, {}};
  if (start) {
    heapOptions.start = start->poses;
    const auto emptyStep = scenes::measureEmptyStep(model, heapOptions);
    if (!emptyStep) return emptyStep.error();
    run.course = scenes::CrushCourse{.emptyStepCpuUs = emptyStep.value(), .worstPenetration = {}, .resolvedAfter = {}};
  }
  auto heap = scenes::Heap::create(model, heapOptions);
  if (!heap) return heap.error();
  scenes::ProgressLine progress(scenes::shapeName(shape));
  const auto show = [&](std::uint32_t done) {
    return progress.show("steps", static_cast<double>(done) / options.steps);
  };
  auto report = start ? scenes::runCrush(*heap.value(), options.steps, *run.course, show)
                      : scenes::runHeap(*heap.value(), options.steps, show);
  if (!report) return report.error();
  run.report = std::move(report).value();
  if (wantsPicture) {
    const Status status = scenes::renderWithPovray(scenes::heapPicture(*heap.value()), {}, *options.picture);
    if (!status) return status.error();
  }
  return run;
}

}  // namespace

Status measureHeaps(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model) {
  std::optional<scenes::CrushStart> start;
  if (options.scene == Scene::crush) {
    auto made = scenes::crushStart(model, options.heap.bodies, options.heap.seed);
    if (!made) return made.error();
    start = std::move(made).value();
  }
  const scenes::CrushStart* const startOrNone = start ? &*start : nullptr;
  std::vector<HeapRun> runs;
  for (const scenes::ShapeKind shape : options.shapes) {
    auto run = runShape(options, model, startOrNone, shape, options.picture && runs.empty());
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
