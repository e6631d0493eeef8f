// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/export.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "cairn/builder/grain.h"
#include "cairn/builder/import.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/export_formats.h"
#include "tool/grain_report.h"
#include "tool/interrupt.h"
#include "tool/sphere_file.h"

namespace cairn::tool {
namespace {

struct ExportCommand {
  std::string input, format, output, mesh, json;
  std::optional<std::uint32_t> level;
  double density = 0;  ///< 0: not given
};

std::string aboutExport() {
  std::string about = "Write a tree, or a cover of `cairn cover`, in another form.\n";
  for (const ExportFormat& format : exportFormats()) about += fmt::format("  {:<9} {}\n", format.name, format.about);
  return about +
         "\n"
         "  cairn export rock.cairn --to spheres -o rock.txt\n"
         "  cairn export rock.cairn --to glb --level 2 -o rock.glb\n"
         "  cairn export rock.cairn --to mesh --level 1 -o far.obj\n"
         "  cairn export grain.txt --mesh grain.stl --to liggghts --density 2650 -o grain.multisphere --json "
         "grain.json\n"
         "\n"
         "Grains (liggghts, yade, chrono, clump) stand for the mesh: the tree's own, or that of --mesh; without one, "
         "for "
         "the\nunion of their spheres. The report gives the mass, centre and inertia of both, exact, at --density.";
}

Status readSpheres(const ExportCommand& command, ExportSource& source) {
  if (!isTreeFile(command.input)) {
    const ExportPart part = exportFormat(command.format).part;
    if (part == ExportPart::tree || part == ExportPart::mesh || command.level)
      return Error{
          fmt::format("{}: holds a flat set of spheres, which has no levels; give a tree (.cairn)", command.input)};
    Result<std::vector<builder::Ball>> balls = builder::readCover(command.input);
    if (!balls) return balls.error();
    source.balls = std::move(balls).value();
    return {};
  }
  Result<SphereTree> tree = loadTree(command.input);
  if (!tree) return tree.error();
  Result<std::vector<builder::Ball>> balls =
      builder::ballsOfLevel(tree.value(), command.level.value_or(tree.value().depth()));
  if (!balls) return Error{fmt::format("{}: {}", command.output, balls.error().message)};
  source.level = command.level.value_or(tree.value().depth());
  source.balls = std::move(balls).value();
  source.mass = tree.value().mass();
  source.massOfMesh = true;
  source.tree = std::move(tree).value();
  return {};
}

Result<ExportSource> readSource(const ExportCommand& command) {
  ExportSource source;
  if (Status s = readSpheres(command, source); !s) return s.error();
  if (!command.mesh.empty()) {
    const auto mesh = builder::importMesh(command.mesh);
    if (!mesh) return mesh.error();
    source.mass = builder::massOf(mesh.value());
    source.massOfMesh = true;
  } else if (!source.massOfMesh) {
    source.mass = builder::massOf(source.balls);
  }
  return source;
}

/// The words LIGGGHTS reads a template with; the mass and its inertia together, or neither, as it asks for.
std::string liggghtsWords(const ExportCommand& command, const ExportSource& source) {
  std::string words = fmt::format("nspheres {} ntry 1000000 spheres file {} type 1", source.balls.size(),
                                  std::filesystem::path(command.output).filename().string());
  if (command.density == 0) return words;
  const double mass = command.density * source.mass.volume;
  const Mat3d i = source.mass.inertia * mass;
  return words + fmt::format(" mass {} inertia_tensor {} {} {} {} {} {}", mass, i(0, 0), i(0, 1), i(0, 2), i(1, 1),
                             i(1, 2), i(2, 2));
}

Json report(const ExportCommand& command, const ExportSource& source) {
  const ExportFormat& format = exportFormat(command.format);
  const double density = command.density == 0 ? 1 : command.density;
  Json json = {{"input", command.input}, {"format", command.format}, {"spheres", source.balls.size()}};
  json["frame"] = std::array{"mesh", "center_of_mass", "principal_axes"}[static_cast<std::size_t>(format.frame)];
  json["stands_for"] = source.massOfMesh ? "mesh" : "spheres";
  if (source.massOfMesh) json["mass"]["mesh"] = massJson(source.mass, density);
  json["mass"]["spheres"] = massJson(builder::massOf(source.balls), density);
  if (command.format == "liggghts") json["liggghts"] = liggghtsWords(command, source);
  return json;
}

int run(const ExportCommand& command) {
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.input, command.mesh}, {command.output, command.json}); !s)
    return refuse(s.error());
  const Result<ExportSource> source = readSource(command);
  if (!source) return refuse(source.error());
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = exportFormat(command.format).write(source.value(), command.output); !s)
    return refuse({fmt::format("{}: {}", command.output, s.error().message)});
  if (!command.json.empty())
    if (Status s = writeJson(report(command, source.value()), command.json); !s) return refuse(s.error());
  return kDone;
}

/// What single options cannot tell; throws as the parser does.
void checkUsage(const ExportCommand& command) {
  const ExportFormat& format = exportFormat(command.format);
  if (command.level && format.part == ExportPart::tree)
    throw CLI::ValidationError("--level",
                               fmt::format("is for single levels; {} always holds the whole tree", format.name));
  if (format.part != ExportPart::grain && (!command.mesh.empty() || command.density != 0))
    throw CLI::ValidationError(command.mesh.empty() ? "--density" : "--mesh",
                               "is for grains: liggghts, yade, chrono, clump");
  const std::string extension = std::filesystem::path(command.output).extension().string();
  for (const ExportFormat& other : exportFormats())
    if (!extension.empty() && extension == other.extension && extension != format.extension)
      throw CLI::ValidationError("--output", fmt::format("ends in {}, but --to is {}", extension, command.format));
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", aboutExport());
  sub->add_option("INPUT", command->input, "Tree file (.cairn), or text `cairn cover` wrote")->required();
  sub->add_option("--to", command->format, "Form to write")->required()->check(CLI::IsMember(exportFormatNames()));
  sub->add_option("--level", command->level, "Level of the tree to write; the deepest unless given");
  sub->add_option("--mesh", command->mesh, "The mesh a grain stands for: its mass, centre and axes");
  sub->add_option("--density", command->density, "Mass per cubic mesh unit, for the masses of the report")
      ->check([](const std::string& text) {
        double value = 0;
        const bool holds = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
        return holds ? std::string() : fmt::format("'{}' is not a density above 0", text);
      });
  sub->add_option("-o,--output", command->output, "File to write")->required();
  sub->add_option("--json", command->json,
                  "Write mass, centre and inertia of mesh and spheres as JSON; - is standard output");
  sub->callback([command, &action] {
    checkUsage(*command);
    action = [command] { return run(*command); };
  });
}

}  // namespace cairn::tool
