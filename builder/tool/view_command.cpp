// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "cairn/builder/import.h"
#include "cairn/builder/robot_view.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"
#include "tool/mesh_source.h"
#include "tool/package_paths.h"
#include "tool/progress_bar.h"
#include "tool/report.h"
#include "tool/sphere_file.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutView =
    "Write a page that shows a tree, a mesh or a robot in a browser: one file, which loads nothing from any "
    "network.\n\n"
    "  cairn view rock.cairn -o rock.html                     every level of a tree\n"
    "  cairn view link.stl -o link.html                       a mesh alone\n"
    "  cairn view link.stl --spheres 20 -o link.html          a mesh and a cover of it\n"
    "  cairn view scan.ply --repair --spheres 20 -o scan.html\n"
    "  cairn view arm.urdf --spheres 16 -o arm.html           a robot: all links, and sliders for its joints\n"
    "  cairn view arm_spheres.urdf -o arm.html                the spheres that `cairn robot` wrote\n\n"
    "The page has a slider of levels, colours by certified error, and says of a sphere one clicks its node, parent,\n"
    "children, triangles, error and radius. Links of a robot whose spheres overlap turn red, except parent and child\n"
    "and pairs that always meet. Keys: arrows, M, S, E, F, U, W, P, R, Esc. It needs WebGL 2.";

struct ViewCommand {
  MeshSourceOptions source;
  std::string output, json;
  std::map<std::string, std::filesystem::path> packages;
  std::optional<std::uint32_t> spheres;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Result<builder::View> viewOfTree(const ViewCommand& command) {
  if (command.spheres || command.source.repair || command.source.wrap)
    return Error{fmt::format("{}: is a tree, which has its spheres; leave out --spheres, --repair and --wrap",
                             command.source.path)};
  const Result<SphereTree> tree = loadTree(command.source.path);
  if (!tree) return tree.error();
  const BuildInfo& info = tree.value().info();
  builder::View view{.title = info.meshName.empty() ? fileName(command.source.path) : info.meshName,
                     .facts = {{"Tree", fileName(command.source.path)}, {"Method", info.method}},
                     .links = {builder::viewLink(tree.value())},
                     .joints = {}};
  return view;
}

/// A mesh alone is shown as it is, open or not: nothing is claimed of it.
Result<builder::View> viewOfMesh(const ViewCommand& command) {
  const Result<builder::TriangleMesh> mesh = builder::importSurface(command.source.path);
  if (!mesh) return mesh.error();
  return builder::View{
      .title = mesh.value().name, .facts = {}, .links = {builder::viewLink(mesh.value())}, .joints = {}};
}

Result<builder::View> viewOfCover(const ViewCommand& command, const builder::ProgressCallback& progress) {
  const Result<MeshSource> source = readMeshSource(command.source, progress);
  if (!source) return source.error();
  builder::View view{.title = source.value().mesh.name, .facts = {}, .links = {}, .joints = {}};
  if (source.value().repair) view.facts.emplace_back("Mesh", "repaired");
  if (source.value().wrap) view.facts.emplace_back("Mesh", "skin of --wrap");
  if (!command.spheres) {
    view.links = {builder::viewLink(source.value().mesh)};
    return view;
  }
  builder::CoverOptions options;
  options.spheres = command.spheres;
  options.seed = command.seed;
  const Result<builder::Cover> cover = builder::coverMesh(source.value().mesh, options, progress);
  if (!cover) return cover.error();
  view.facts.emplace_back("Cover", builder::objectiveName(options.objective));
  view.links = {builder::viewLink(source.value().mesh, cover.value())};
  return view;
}

Result<builder::View> viewOfRobot(const ViewCommand& command, const builder::ProgressCallback& progress) {
  if (command.source.repair || command.source.wrap)
    return Error{
        fmt::format("{}: is a robot, whose meshes are repaired or wrapped where they need it; leave out "
                    "--repair and --wrap",
                    command.source.path)};
  const Result<builder::RobotModel> model = builder::readUrdf(command.source.path);
  if (!model) return model.error();
  builder::RobotViewOptions options;
  options.spheres = command.spheres;
  options.packages = command.packages;
  options.seed = command.seed;
  return builder::robotView(model.value(), command.source.path, options, progress);
}

Result<builder::View> readView(const ViewCommand& command, const builder::ProgressCallback& progress) {
  if (std::filesystem::path(command.source.path).extension() == ".urdf") return viewOfRobot(command, progress);
  if (isTreeFile(command.source.path) && !builder::isMeshFile(command.source.path)) return viewOfTree(command);
  if (!command.spheres && !command.source.repair && !command.source.wrap) return viewOfMesh(command);
  return viewOfCover(command, progress);
}

struct ViewCounts {
  std::size_t spheres = 0, triangles = 0;

  explicit ViewCounts(const builder::View& view) {
    for (const builder::ViewLink& link : view.links) {
      spheres += link.spheres.size();
      triangles += link.triangles.size();
    }
  }
};

Json report(const ViewCommand& command, const builder::View& view, const builder::ViewPage& page) {
  const ViewCounts counts(view);
  return {{"input", command.source.path},  {"page", command.output},          {"title", view.title},
          {"links", view.links.size()},    {"joints", view.joints.size()},    {"spheres", counts.spheres},
          {"triangles", counts.triangles}, {"page_bytes", page.html.size()},  {"viewer_bytes", page.viewerBytes},
          {"mesh_bytes", page.meshBytes},  {"sphere_bytes", page.sphereBytes}};
}

int run(const ViewCommand& command) {
  if (!builder::hasViewer()) return refuse(builder::viewPage({}).error());
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.source.path}, {command.output, command.json}); !s) return refuse(s.error());
  ProgressBar bar;
  const Result<builder::View> view = readView(command, bar.callback());
  if (!view) return refuse(view.error());
  const Result<builder::ViewPage> page = builder::viewPage(view.value());
  if (!page) return refuse(page.error());
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = writeFileAtomically(command.output, page.value().html); !s) return refuse(s.error());
  const Json json = report(command, view.value(), page.value());
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json == "-") return kDone;
  const ViewCounts counts(view.value());
  fmt::print("{}: {} spheres, {} triangles, {} kB: viewer {}, mesh {}, spheres {}. Open it in a browser.\n",
             command.output, counts.spheres, counts.triangles, page.value().html.size() / 1000,
             page.value().viewerBytes / 1000, page.value().meshBytes / 1000, page.value().sphereBytes / 1000);
  return kDone;
}

}  // namespace

void addViewCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<ViewCommand>();
  CLI::App* sub = app.add_subcommand("view", kAboutView);
  sub->add_option("INPUT", command->source.path, "Tree (.cairn), robot (.urdf), or mesh: OBJ, OFF, PLY, STL, glTF, ...")
      ->required();
  sub->add_option("-o,--output", command->output, "Page to write (HTML)")->required();
  sub->add_option(
         "--spheres", command->spheres,
         "Cover the mesh, or each link, by so many spheres, as `cairn cover` and `cairn robot --primitives` do")
      ->check(CLI::Range(1U, builder::kMaxCoverSpheres));
  addPackageOption(*sub, command->packages);
  CLI::Option* repair = sub->add_flag("--repair", command->source.repair, "Close and mend the mesh first");
  CLI::Option* wrap = sub->add_flag("--wrap", command->source.wrap, "Show a closed skin around the mesh instead");
  repair->excludes(wrap);
  addSeedOption(*sub, command->seed, "Of the cover: same mesh, number and seed, same bytes");
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write counts and sizes in bytes as JSON too; - is standard output");
  sub->callback([command, &action] {
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool
