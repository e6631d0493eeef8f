// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>

#include "cairn/builder/certify_balls.h"
#include "cairn/builder/grain.h"
#include "cairn/builder/import.h"

#include "tool/command.h"
#include "tool/cover_report.h"
#include "tool/examination.h"
#include "tool/package_paths.h"
#include "tool/progress_bar.h"
#include "tool/robot_certificate.h"
#include "tool/sphere_file.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutCertify =
    "Prove that a tree bounds a mesh: every point of every triangle lies in a sphere of each level that can be "
    "reached\n"
    "through spheres holding it too, no sphere reaches farther outside than the tree says, and inner spheres lie "
    "inside.\n"
    "Checked too: the mesh the tree stores and its mass properties are the mesh's, normal cones hold their triangles' "
    "normals,\n"
    "support points lie in their spheres, and each level's mesh is closed and as near as it says. Not proved: that "
    "support points, face normals and region triangles, from "
    "which\n"
    "contacts are made, are well chosen.\n"
    "Ends with 1 and the first gap found when that is not so; --json has them all. For a tree built with --repair or "
    "--wrap, MESH is what "
    "--mesh-output wrote.\n"
    "Of a text with a line `x y z r ...` a sphere, whoever made it, it proves how far spheres stick out and what they "
    "leave\n"
    "out of the surface and of the solid. Of a robot and the URDF with its spheres it proves the same link by link.\n\n"

    "  cairn certify rock.obj rock.cairn\n"
    "  cairn certify rock.obj rock.cairn --json proof.json\n"
    "  cairn certify link.stl spheres.txt\n"
    "  cairn certify arm.urdf arm_spheres.urdf";

struct CertifyCommand {
  std::string mesh, tree, json;
  std::map<std::string, std::filesystem::path> packages;
  unsigned threads = 0;
};

Json certificateJson(const Examination& examination, unsigned threads) {
  Json json = examinationJson(examination, builder::Sampling::none, threads);
  Json& nodes = json["node_certificates"] = Json::array();
  for (std::size_t i = 0; i < examination.certificate.nodes.size(); ++i) {
    const builder::NodeCertificate& c = examination.certificate.nodes[i];
    nodes.push_back({{"error", examination.tree.data().nodes[i].error},
                     {"protrusion_upper", c.protrusionUpper},
                     {"protrusion_lower", c.protrusionLower},
                     {"depth", c.depth}});
  }
  json["failures"] = examination.failures;
  return json;
}

/// A flat set claims nothing that could be refuted: what is proved about it is told.
int certifyFlat(const CertifyCommand& command) {
  const auto mesh = builder::importMesh(command.mesh);
  if (!mesh) return refuse(mesh.error());
  const auto balls = builder::readCover(command.tree);
  if (!balls) return refuse(balls.error());
  ProgressBar bar;
  const auto certificate = builder::certifyBalls(balls.value(), mesh.value(), bar.callback());
  if (!certificate) return refuse(certificate.error());
  const double diagonal = builder::boundsOf(mesh.value()).diagonal();
  const Json json = {{"mesh", mesh.value().name},
                     {"spheres", balls.value().size()},
                     {"diagonal", diagonal},
                     {"certified", certifiedJson(certificate.value(), diagonal)},
                     {"volume_ratio", builder::massOf(balls.value()).volume / builder::massOf(mesh.value()).volume},
                     {"threads", threadsUsed(command.threads)}};
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") printCertified(certificate.value(), diagonal);
  return kDone;
}

int run(const CertifyCommand& command) {
  if (Status s = checkOutputs({command.mesh, command.tree}, {command.json}); !s) return refuse(s.error());
  if (std::filesystem::path(command.mesh).extension() == ".urdf")
    return certifyRobotCommand(command.mesh, command.tree, command.packages, command.json, command.threads);
  if (std::filesystem::exists(command.tree) && !isTreeFile(command.tree)) return certifyFlat(command);
  const auto examination = examine(command.mesh, command.tree, builder::Sampling::none, 0);
  if (!examination) return refuse(examination.error());
  const Json json = certificateJson(examination.value(), command.threads);
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json != "-") printLevels(examination.value().fits, builder::Sampling::none);
  return refuseUnproved(examination.value(), command.tree);
}

}  // namespace

void addCertifyCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<CertifyCommand>();
  CLI::App* sub = app.add_subcommand("certify", kAboutCertify);
  sub->add_option("MESH", command->mesh, "The mesh the tree is said to bound, or a robot's URDF")->required();
  sub->add_option("TREE", command->tree, "Tree file (.cairn), text of spheres, or URDF with <sphere> collisions")
      ->required();
  addPackageOption(*sub, command->packages);
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write the findings as JSON too; - is standard output");
  sub->callback([command, &action] {
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool
