// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/report.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutInspect =
    "Show what is in a tree file: how it was built, its levels, mass properties and size in memory.\n\n"
    "  cairn inspect rock.cairn\n"
    "  cairn inspect rock.cairn --json -";

struct InspectCommand {
  std::string tree, json;
};

Json vectorJson(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

/// Diagonal of the source mesh's bounding box.
double diagonalOf(const SphereTree& tree) {
  Vec3 lower = tree.vertices().front(), upper = lower;
  for (const Vec3& v : tree.vertices()) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], v[axis]);
      upper[axis] = std::max(upper[axis], v[axis]);
    }
  }
  return distance(Vec3d(lower), Vec3d(upper));
}

Json describe(const SphereTree& tree) {
  const double diagonal = diagonalOf(tree);
  Json json = buildInfoJson(tree);
  json["leaves"] = tree.leafCount();
  json["spheres_per_node"] = tree.spheresPerNode();
  json["vertices"] = tree.vertices().size();
  json["triangles"] = tree.triangles().size();
  json["diagonal"] = diagonal;
  json["memory_bytes"] = tree.memoryBytes();
  json["mesh_sha256"] = tree.info().meshSha256;
  json["tree_sha256"] = treeSha256(tree);
  json["volume"] = tree.mass().volume;
  json["center_of_mass"] = vectorJson(tree.mass().centerOfMass);
  json["principal_moments_per_mass"] = vectorJson(tree.mass().principalMoments);
  Json& levels = json["levels"] = Json::array();
  for (std::uint32_t level = 0; level <= tree.depth(); ++level) {
    levels.push_back({{"level", level},
                      {"spheres", tree.levelCut(level).size()},
                      {"error_max", tree.levelError(level)},
                      {"error_max_fraction", tree.levelError(level) / diagonal}});
    if (level == 0 || level > tree.levelMeshCount()) continue;
    const LevelMesh& mesh = tree.levelMesh(level);
    levels.back()["mesh_triangles"] = mesh.triangles.size();
    levels.back()["mesh_distance"] = mesh.distance;
    levels.back()["mesh_distance_fraction"] = mesh.distance / diagonal;
  }
  return json;
}

void print(const std::string& file, const Json& json) {
  fmt::print("{}: {} nodes, {}{} leaves, {} KiB in memory\n", file, json["nodes"].get<std::uint64_t>(),
             json["spheres_per_node"] == 2 ? "each with a sphere that bounds and one that answers, " : "",
             json["leaves"].get<std::uint64_t>(), json["memory_bytes"].get<std::uint64_t>() / 1024);
  fmt::print("built from {} ({} triangles, diagonal {:.6g}) by {}, branching {}, depth {}, {} samples, seed {}\n",
             json["mesh"].get<std::string>(), json["triangles"].get<std::uint64_t>(), json["diagonal"].get<double>(),
             json["method"].get<std::string>(), json["branching"].get<std::uint64_t>(),
             json["depth"].get<std::uint64_t>(), json["samples"].get<std::uint64_t>(),
             json["seed"].get<std::uint64_t>());
  fmt::print("volume {:.6g}, centre of mass {}, principal moments per mass {}\n", json["volume"].get<double>(),
             json["center_of_mass"].dump(), json["principal_moments_per_mass"].dump());
  fmt::print("level  spheres  stored error, max\n");
  for (const Json& level : json["levels"]) {
    fmt::print("{:5}  {:7}  {:.6g} ({:.4f} % of the diagonal)", level["level"].get<std::uint64_t>(),
               level["spheres"].get<std::uint64_t>(), level["error_max"].get<double>(),
               100 * level["error_max_fraction"].get<double>());
    if (level.contains("mesh_triangles"))
      fmt::print("; its mesh: {} triangles, {:.4f} %", level["mesh_triangles"].get<std::uint64_t>(),
                 100 * level["mesh_distance_fraction"].get<double>());
    fmt::print("\n");
  }
}

int run(const InspectCommand& command) {
  if (Status s = checkOutputs({command.tree}, {command.json}); !s) return refuse(s.error());
  const Result<SphereTree> tree = loadTree(command.tree);
  if (!tree) return refuse(tree.error());
  const Json json = describe(tree.value());
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") print(command.tree, json);
  return kDone;
}

}  // namespace

void addInspectCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<InspectCommand>();
  CLI::App* sub = app.add_subcommand("inspect", kAboutInspect);
  sub->add_option("TREE", command->tree, "Tree file (.cairn)")->required();
  sub->add_option("--json", command->json, "Write the description as JSON too; - is standard output");
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace cairn::tool
