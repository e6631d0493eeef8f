// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/fracture.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/import.h"
#include "cairn/builder/simplify.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"
#include "tool/progress_bar.h"
#include "tool/report.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutFracture =
    "Cut a solid into the branches of its sphere-tree, for bodies that break: the mesh and the tree of every piece, "
    "and\n"
    "which pieces touch across which area. Pieces stay in the mesh's own frame.\n\n"
    "  cairn fracture rock.obj -o pieces             up to eight pieces, rock.fracture.json lists them\n"
    "  cairn fracture rock.obj -o pieces --branching 4 --depth 2";

struct FractureCommand {
  std::string mesh, folder;
  std::string method = builder::methodName(builder::BuildOptions{}.method);
  builder::BuildOptions options;
};

struct Piece {
  std::string name;
  SphereTree tree;
};

std::string stem(const FractureCommand& command) {
  return std::filesystem::path(command.mesh).stem().string();
}

Json pieceJson(const builder::Fracture& fracture, std::size_t i, const Piece& piece) {
  const MassProperties& mass = piece.tree.mass();
  return {{"mesh", piece.name + ".obj"},
          {"tree", piece.name + ".cairn"},
          {"branch", fracture.branches[i]},
          {"triangles", fracture.pieces[i].triangles.size()},
          {"volume", mass.volume},
          {"center_of_mass", {mass.centerOfMass.x, mass.centerOfMass.y, mass.centerOfMass.z}}};
}

Json reportOf(const FractureCommand& command, const builder::Fracture& fracture, const std::vector<Piece>& pieces) {
  Json json{{"mesh", command.mesh}, {"volume_error_fraction", fracture.volumeError}};
  for (std::size_t i = 0; i < pieces.size(); ++i) json["pieces"].push_back(pieceJson(fracture, i, pieces[i]));
  json["bonds"] = Json::array();
  for (const builder::Bond& bond : fracture.bonds)
    json["bonds"].push_back({{"pieces", {bond.first, bond.second}}, {"area", bond.area}});
  return json;
}

/// Puts the subject before an error. The error of a cancelled run is recognised by its text and stays unchanged.
Error about(const std::string& what, const Error& error) {
  if (error.message == builder::kCancelled) return error;
  return {fmt::format("{}: {}", what, error.message)};
}

Result<SphereTree> provenTree(const builder::TriangleMesh& mesh, const builder::BuildOptions& options,
                              const builder::ProgressCallback& progress) {
  auto tree = builder::buildTree(mesh, options, progress);
  if (!tree) return tree;
  const auto certificate = builder::certify(tree.value(), mesh, progress);
  if (!certificate) return certificate.error();
  const auto failures = certificate.value().failures(tree.value());
  if (failures.empty()) return tree;
  return Error{
      fmt::format("its tree could not be certified ({}); try other options and report this mesh", failures.front())};
}

/// Fails unless the folder exists or can be made. Called before the work whose files it will hold.
Status checkFolder(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::path there = folder.lexically_normal();
  while (!there.empty() && !std::filesystem::exists(there, ignored)) there = there.parent_path();
  if (!there.empty() && !std::filesystem::is_directory(there, ignored))
    return Error{fmt::format("{}: {} is no folder; name another one", folder.string(), there.string())};
  // A file in the last folder that exists could be written exactly if a folder could be made in it.
  return checkWritable(there / "pieces");
}

Result<std::vector<Piece>> treesOf(const FractureCommand& command, const builder::Fracture& fracture,
                                   const builder::ProgressCallback& progress) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < fracture.pieces.size(); ++i) {
    auto tree = provenTree(fracture.pieces[i], command.options, progress);
    if (!tree) return about(fmt::format("piece {}", i), tree.error());
    pieces.push_back({fmt::format("{}.{}", stem(command), i), std::move(tree).value()});
  }
  return pieces;
}

std::filesystem::path listOf(const FractureCommand& command) {
  return std::filesystem::path(command.folder) / (stem(command) + ".fracture.json");
}

// The list last, and an old one goes first: where it is, everything it names is.
Status write(const FractureCommand& command, const builder::Fracture& fracture, const std::vector<Piece>& pieces) {
  const std::filesystem::path folder = command.folder;
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", command.folder, failure.message())};
  std::filesystem::remove(listOf(command), failure);
  if (failure) return Error{fmt::format("cannot replace {}: {}", listOf(command).string(), failure.message())};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string mesh = builder::objText(fracture.pieces[i]);
    if (Status s = writeFileAtomically(folder / (pieces[i].name + ".obj"), mesh); !s) return s;
    if (Status s = saveTree(pieces[i].tree, folder / (pieces[i].name + ".cairn")); !s) return s;
  }
  return writeJson(reportOf(command, fracture, pieces), listOf(command).string());
}

int run(FractureCommand& command) {
  const auto method = builder::parseMethod(command.method);
  if (!method) return refuse(method.error());
  command.options.method = method.value();
  if (Status s = checkFolder(command.folder); !s) return refuse(s.error());
  const auto mesh = builder::importMesh(command.mesh);
  if (!mesh) return refuse(mesh.error());
  ProgressBar bar;
  builder::BuildOptions coarse = command.options;
  coarse.depth = 1;
  const auto tree = builder::buildTree(mesh.value(), coarse, bar.callback());
  if (!tree) return refuse(tree.error());
  const auto fracture = builder::fracture(mesh.value(), tree.value(), bar.callback());
  if (!fracture) return refuse(about(command.mesh, fracture.error()));
  const auto pieces = treesOf(command, fracture.value(), bar.callback());
  if (!pieces) return refuse(pieces.error());
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = write(command, fracture.value(), pieces.value()); !s) return refuse(s.error());
  fmt::print("{}: {} pieces, {} bonds, volume kept to {:.1e}\n", command.folder, pieces.value().size(),
             fracture.value().bonds.size(), fracture.value().volumeError);
  return kDone;
}

}  // namespace

void addFractureCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<FractureCommand>();
  CLI::App* sub = app.add_subcommand("fracture", kAboutFracture);
  sub->add_option("MESH", command->mesh, "Closed triangle mesh: OBJ, OFF, PLY, STL, glTF, ...")->required();
  sub->add_option("-o,--output", command->folder, "Folder to write to")->required();
  sub->add_option("--method", command->method, "How regions are covered by spheres")
      ->check(CLI::IsMember(builder::methodNames()))
      ->capture_default_str();
  sub->add_option("--branching", command->options.branching, "Most branches to cut into, and children of a sphere")
      ->check(CLI::Range(2U, 8U))
      ->capture_default_str();
  sub->add_option("--depth", command->options.depth, "Levels of the pieces' trees")
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  addSeedOption(*sub, command->options.seed, "Same mesh, options and seed: same bytes");
  addThreadsOption(*sub, command->options.threads);
  sub->callback([command, &action] {
    action = [command] { return withThreads(command->options.threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool
