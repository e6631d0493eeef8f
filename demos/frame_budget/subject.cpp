// SPDX-License-Identifier: GPL-3.0-or-later
#include "subject.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "scenes/command/program.h"

namespace cairn::frame_budget {
namespace {

Status checkSpheresLevel(const Options& options, const SphereTree& tree) {
  const bool isAsked = std::ranges::find(options.shapes, scenes::ShapeKind::spheres) != options.shapes.end();
  const std::uint32_t level = options.heap.shape.sphereLevel;
  if (!isAsked || level <= tree.depth()) return {};
  return Error{fmt::format("the tree has no level {}: use 0 to {} for --spheres-level", level, tree.depth())};
}

}  // namespace

Result<Subject> obtainSubject(const Options& options) {
  scenes::ProgressLine progress("building the sphere-tree");
  auto source = scenes::obtainTree(options.source, progress.callback());
  if (!source) return source.error();
  if (Status level = checkSpheresLevel(options, *source.value().tree); !level) return level.error();
  scenes::Model model = scenes::makeModel(source.value().tree, 1.0);
  return Subject{std::move(source).value(), std::move(model)};
}

}  // namespace cairn::frame_budget
