// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify.h"

#include <fmt/format.h>

#include <memory>

#include "cairn/builder/evaluate.h"
#include "tool/command.h"
#include "tool/mesh_and_tree.h"
#include "tool/progress_bar.h"
#include "tool/report.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAbout =
    "Prove that a tree bounds a mesh: every point of every triangle lies in a sphere of each level that can be "
    "reached\n"
    "through spheres holding it too, no sphere reaches farther outside than the tree says, and inner spheres lie "
    "inside.\n"
    "Checked too: the mesh the tree stores and its mass properties are the mesh's, normal cones hold their triangles' "
    "normals,\n"
    "support points lie in their spheres. Not proved: that support points, face normals and region triangles, from "
    "which\n"
    "contacts are made, are well chosen.\n"
    "Ends with 1 and the first gap found when that is not so.\n\n"
    "  cairn certify rock.obj rock.cairn\n"
    "  cairn certify rock.obj rock.cairn --json proof.json";

struct CertifyCommand {
  std::string mesh, tree, json;
  unsigned threads = 0;
};

Json certificateJson(const MeshAndTree& input, unsigned threads, const builder::Certificate& certificate,
                     const std::vector<builder::LevelFit>& fits, const std::vector<std::string>& failures) {
  Json json = buildInfoJson(input.tree);
  json["mesh"] = input.mesh.name;
  json["threads"] = threadsUsed(threads);
  json["build_cpu_s"] = nullptr;  // a tree file does not tell
  json["build_wall_s"] = nullptr;
  json["peak_rss_mb"] = peakMemoryMb();
  json["tree_sha256"] = treeSha256(input.tree);
  json["proven"] = failures.empty();
  json["levels"] = levelsJson(fits, builder::Sampling::none);
  Json& nodes = json["node_certificates"] = Json::array();
  for (std::size_t i = 0; i < certificate.nodes.size(); ++i) {
    const builder::NodeCertificate& c = certificate.nodes[i];
    nodes.push_back({{"error", input.tree.data().nodes[i].error},
                     {"protrusion_upper", c.protrusionUpper},
                     {"protrusion_lower", c.protrusionLower},
                     {"depth", c.depth}});
  }
  json["failures"] = failures;
  return json;
}

int run(const CertifyCommand& command) {
  if (Status s = checkOutputs({command.mesh, command.tree}, {command.json}); !s) return refuse(s.error());
  const Result<MeshAndTree> input = readMeshAndTree(command.mesh, command.tree);
  if (!input) return refuse(input.error());
  const auto& [mesh, tree] = input.value();
  ProgressBar bar;
  const auto certificate = builder::certify(tree, mesh, bar.callback());
  if (!certificate) return refuse(certificate.error());
  const auto fits = builder::evaluate(tree, mesh, certificate.value(), builder::Sampling::none, 0);
  if (!fits) return refuse(fits.error());
  const std::vector<std::string> failures = certificate.value().failures(tree);
  const Json json = certificateJson(input.value(), command.threads, certificate.value(), fits.value(), failures);
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") {
    printLevels(fits.value(), builder::Sampling::none);
    for (const std::string& failure : failures) fmt::print("{}\n", failure);
  }
  return refuseUnproved(input.value(), command.tree, failures);
}

}  // namespace

void addCertifyCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<CertifyCommand>();
  CLI::App* sub = app.add_subcommand("certify", kAbout);
  sub->add_option("MESH", command->mesh, "The mesh the tree is said to bound")->required();
  sub->add_option("TREE", command->tree, "Tree file (.cairn)")->required();
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write the findings as JSON too; - is standard output");
  sub->callback([command, &action] {
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool
