// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <fmt/format.h>

#include <memory>

#include "tool/command.h"
#include "tool/mesh_and_tree.h"
#include "tool/progress_bar.h"
#include "tool/report.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAbout =
    "Measure how well each level of a tree fits a mesh, certified and sampled.\n"
    "Ends with 1 when what `cairn certify` proves cannot be proved.\n\n"
    "  cairn evaluate rock.obj rock.cairn\n"
    "  cairn evaluate rock.obj rock.cairn --json - | jq .levels";

struct EvaluateCommand {
  std::string mesh, tree, json;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

int run(const EvaluateCommand& command) {
  if (Status s = checkOutputs({command.mesh, command.tree}, {command.json}); !s) return refuse(s.error());
  const Result<MeshAndTree> input = readMeshAndTree(command.mesh, command.tree);
  if (!input) return refuse(input.error());
  const auto& [mesh, tree] = input.value();
  ProgressBar bar;
  const auto certificate = builder::certify(tree, mesh, bar.callback());
  if (!certificate) return refuse(certificate.error());
  const auto fits =
      builder::evaluate(tree, mesh, certificate.value(), builder::Sampling::full, command.seed, bar.callback());
  if (!fits) return refuse(fits.error());
  Json json = buildInfoJson(tree);
  json["mesh"] = mesh.name;
  json["threads"] = threadsUsed(command.threads);
  json["build_cpu_s"] = nullptr;  // a tree file does not tell
  json["build_wall_s"] = nullptr;
  json["peak_rss_mb"] = peakMemoryMb();
  json["tree_sha256"] = treeSha256(tree);
  json["levels"] = levelsJson(fits.value(), builder::Sampling::full);
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") printLevels(fits.value(), builder::Sampling::full);
  return refuseUnproved(input.value(), command.tree, certificate.value().failures(tree));
}

}  // namespace

void addEvaluateCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* sub = app.add_subcommand("evaluate", kAbout);
  sub->add_option("MESH", command->mesh, "The mesh to compare with")->required();
  sub->add_option("TREE", command->tree, "Tree file (.cairn)")->required();
  addSeedOption(*sub, command->seed, "Of the sampled measures");
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write the report as JSON too; - is standard output");
  sub->callback([command, &action] {
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool
