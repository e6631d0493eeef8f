// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/evaluate.h"

#include <memory>

#include "tool/command.h"
#include "tool/examination.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutEvaluate =
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
  const auto examination = examine(command.mesh, command.tree, builder::Sampling::full, command.seed);
  if (!examination) return refuse(examination.error());
  const Json json = examinationJson(examination.value(), builder::Sampling::full, command.threads);
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") printLevels(examination.value().fits, builder::Sampling::full);
  return refuseUnproved(examination.value(), command.tree);
}

}  // namespace

void addEvaluateCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* sub = app.add_subcommand("evaluate", kAboutEvaluate);
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
