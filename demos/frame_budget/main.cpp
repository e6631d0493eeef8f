// SPDX-License-Identifier: GPL-3.0-or-later
// frame_budget: what a scene's collision costs and how right it is, for one shape or several in the same run.
#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "options.h"
#include "report.h"
#include "scenes/heap_picture.h"
#include "scenes/heap_run.h"
#include "scenes/povray.h"
#include "scenes/program.h"
#include "step_log.h"

namespace cairn::frame_budget {
namespace {

Result<ShapeRun> runShape(const Options& options, const scenes::Model& model, scenes::ShapeKind shape,
                          bool wantsPicture) {
  scenes::HeapOptions heapOptions = options.heap;
  heapOptions.world.shape = shape;
  auto heap = scenes::Heap::create(model, heapOptions);
  if (!heap) return heap.error();
  scenes::ProgressLine progress(scenes::shapeName(shape));
  auto report = scenes::runHeap(*heap.value(), options.steps, [&](std::uint32_t done) {
    return progress.show("steps", static_cast<double>(done) / options.steps);
  });
  if (!report) return report.error();
  if (wantsPicture) {
    const Status status = scenes::renderWithPovray(scenes::heapPicture(*heap.value()), {}, *options.picture);
    if (!status) return status.error();
  }
  return ShapeRun{shape, std::move(report).value()};
}

Result<scenes::SourcedTree> obtainTree(const Options& options) {
  scenes::ProgressLine progress("building the sphere-tree");
  return scenes::obtainTree(options.source, progress.callback());
}

Status checkSpheresLevel(const Options& options, const SphereTree& tree) {
  const bool isAsked = std::ranges::find(options.shapes, scenes::ShapeKind::spheres) != options.shapes.end();
  const std::uint32_t level = options.heap.shape.sphereLevel;
  if (!isAsked || level <= tree.depth()) return {};
  return Error{fmt::format("the tree has no level {}: use 0 to {} for --spheres-level", level, tree.depth())};
}

Status measure(const Options& options) {
  for (const auto& output : {options.json, options.csv, options.picture})
    if (output)
      if (Status writable = checkWritable(*output); !writable) return writable;
  const auto source = obtainTree(options);
  if (!source) return source.error();
  if (Status level = checkSpheresLevel(options, *source.value().tree); !level) return level;
  const scenes::Model model = scenes::makeModel(source.value().tree, 1.0);
  std::vector<ShapeRun> runs;
  for (const scenes::ShapeKind shape : options.shapes) {
    auto run = runShape(options, model, shape, options.picture && runs.empty());
    if (!run) return run.error();
    runs.push_back(std::move(run).value());
  }
  printTable(options, source.value(), runs);
  if (options.csv)
    if (Status written = writeFileAtomically(*options.csv, stepLog(runs)); !written) return written;
  if (!options.json) return {};
  return writeFileAtomically(*options.json, reportToJson(options, source.value(), runs).dump(2) + "\n");
}

}  // namespace
}  // namespace cairn::frame_budget

int main(int argc, char** argv) {
  using namespace cairn;
  const auto parsed = frame_budget::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const Status status = frame_budget::measure(std::get<frame_budget::Options>(parsed));
  return status ? scenes::kExitDone : scenes::refuse("frame_budget", status.error());
}
