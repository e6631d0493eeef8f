// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs.h"

#include "cairn/core/atomic_file.h"

namespace cairn::frame_budget {
namespace {

nlohmann::ordered_json treeToJson(const scenes::SourcedTree& source) {
  const SphereTree& tree = *source.tree;
  nlohmann::ordered_json json{{"method", tree.info().method}, {"branching", tree.info().branching},
                              {"depth", tree.depth()},        {"spheres", tree.nodeCount()},
                              {"leaves", tree.leafCount()},   {"triangles", tree.triangles().size()}};
  json["build_wall_s"] = source.buildWallSeconds > 0 ? nlohmann::ordered_json(source.buildWallSeconds) : nullptr;
  return json;
}

}  // namespace

Status checkOutputs(const Options& options) {
  const auto orNone = [](const auto& path) { return path ? std::filesystem::path(*path) : std::filesystem::path(); };
  return cairn::checkOutputs({orNone(options.source.mesh), orNone(options.source.tree)},
                             {orNone(options.json), orNone(options.csv), orNone(options.picture)});
}

Status writeOutputs(const Options& options, const std::vector<nlohmann::ordered_json>& objects,
                    const std::vector<LoggedRun>& runs) {
  if (options.csv)
    if (Status written = writeFileAtomically(*options.csv, stepLog(runs)); !written) return written;
  if (!options.json) return {};
  const nlohmann::ordered_json json = objects.size() == 1 ? objects.front() : nlohmann::ordered_json(objects);
  return writeFileAtomically(*options.json, json.dump(2) + "\n");
}

nlohmann::ordered_json describeRun(const Options& options, const scenes::SourcedTree& source, scenes::ShapeKind shape) {
  nlohmann::ordered_json json{
      {"scene", sceneName(options.scene)}, {"mesh", source.meshName}, {"bodies", options.heap.bodies},
      {"shape", scenes::shapeName(shape)}, {"steps", options.steps},  {"seed", options.heap.seed}};
  json["sleeping"] = options.heap.world.sleeping;
  json["budget_ops"] = orNull(options.heap.world.budget.operations);
  json["budget_us"] = orNull(options.heap.world.budget.microseconds);
  json["priority"] = options.priority;
  json["unresolved"] = options.unresolved;
  json["margin_fraction"] = orNull(options.heap.shape.marginFraction);
  json["max_contact_error_fraction"] = options.heap.shape.maxContactError;
  json["tree"] = treeToJson(source);
  return json;
}

}  // namespace cairn::frame_budget
