// SPDX-License-Identifier: GPL-3.0-or-later
// frame_budget: what a scene's collision costs and how right it is, for one shape or several in the same run.
#include <fmt/core.h>

#include <algorithm>

#include "converge_scene.h"
#include "heap_scenes.h"
#include "options.h"
#include "outputs.h"
#include "scenes/command/program.h"

namespace cairn::frame_budget {
namespace {

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
  if (Status outputs = checkOutputs(options); !outputs) return outputs;
  const auto source = obtainTree(options);
  if (!source) return source.error();
  if (Status level = checkSpheresLevel(options, *source.value().tree); !level) return level;
  const scenes::Model model = scenes::makeModel(source.value().tree, 1.0);
  return options.scene == Scene::converge ? measureConverge(options, source.value(), model)
                                          : measureHeaps(options, source.value(), model);
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
