// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/export.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutExport =
    "Write a tree in another form.\n"
    "  spheres  text, one line `level x y z r parent` per sphere, breadth-first\n"
    "  sph      text of Bradshaw's sphere-tree toolkit\n"
    "  obj, glb the spheres of one level as a surface, for looking at\n\n"
    "  cairn export rock.cairn --to spheres -o rock.txt\n"
    "  cairn export rock.cairn --to glb --level 2 -o rock.glb";

struct ExportCommand {
  std::string tree, format, output;
  std::optional<std::uint32_t> level;
};

Status write(const SphereTree& tree, const ExportCommand& command) {
  if (command.format == "spheres") return writeFileAtomically(command.output, builder::spheresText(tree));
  if (command.format == "sph") {
    const Result<std::string> text = builder::sphText(tree);
    if (!text) return text.error();
    return writeFileAtomically(command.output, text.value());
  }
  const auto format = command.format == "obj" ? builder::SurfaceFormat::obj : builder::SurfaceFormat::glb;
  return builder::writeSphereSurfaces(tree, command.level.value_or(tree.depth()), format, command.output);
}

int run(const ExportCommand& command) {
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.tree}, {command.output}); !s) return refuse(s.error());
  const Result<SphereTree> tree = loadTree(command.tree);
  if (!tree) return refuse(tree.error());
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = write(tree.value(), command); !s)
    return refuse({fmt::format("{}: {}", command.output, s.error().message)});
  return kDone;
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<ExportCommand>();
  CLI::App* sub = app.add_subcommand("export", kAboutExport);
  sub->add_option("TREE", command->tree, "Tree file (.cairn)")->required();
  sub->add_option("--to", command->format, "Form to write")
      ->required()
      ->check(CLI::IsMember({"spheres", "sph", "obj", "glb"}));
  sub->add_option("--level", command->level, "Level to write as obj or glb; the deepest unless given");
  sub->add_option("-o,--output", command->output, "File to write")->required();
  sub->callback([command, &action] {
    if (command->level && (command->format == "spheres" || command->format == "sph"))
      throw CLI::ValidationError("--level", "is for obj and glb; spheres and sph always hold the whole tree");
    const std::string extension = std::filesystem::path(command->output).extension().string();
    for (const char* other : {"obj", "glb"})
      if (extension == fmt::format(".{}", other) && command->format != other)
        throw CLI::ValidationError("--output", fmt::format("ends in .{}, but --to is {}", other, command->format));
    action = [command] { return run(*command); };
  });
}

}  // namespace cairn::tool
