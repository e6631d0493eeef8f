// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/simplify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>

#include "cairn/builder/import.h"
#include "cairn/core/atomic_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"
#include "tool/progress_bar.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutSimplify =
    "Write a closed mesh with fewer triangles, as OBJ: a scan is far finer than a game wants to carry.\n\n"
    "  cairn simplify scan.ply --triangles 1500 -o rock.obj";

struct SimplifyCommand {
  std::string mesh, output;
  std::uint32_t triangles = 1500;
};

Status checkIsObj(const std::string& output) {
  std::string extension = std::filesystem::path(output).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  if (extension == ".obj" || !std::filesystem::path(output).has_extension()) return {};
  return Error{fmt::format("{}: only OBJ can be written; name a file that ends in .obj", output)};
}

int run(const SimplifyCommand& command) {
  if (Status s = checkIsObj(command.output); !s) return refuse(s.error());
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.mesh}, {command.output}); !s) return refuse(s.error());
  const Result<builder::TriangleMesh> mesh = builder::importMesh(command.mesh);
  if (!mesh) return refuse(mesh.error());
  ProgressBar bar;
  const auto simple = builder::simplify(mesh.value(), command.triangles, bar.callback());
  if (interrupted()) return refuse({std::string(builder::kCancelled)});
  if (!simple) return refuse({fmt::format("{}: {}", command.mesh, simple.error().message)});
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = writeFileAtomically(command.output, builder::objText(simple.value())); !s) return refuse(s.error());
  fmt::print("{}: {} of {} triangles\n", command.output, simple.value().triangles.size(),
             mesh.value().triangles.size());
  return kDone;
}

}  // namespace

void addSimplifyCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<SimplifyCommand>();
  CLI::App* sub = app.add_subcommand("simplify", kAboutSimplify);
  sub->add_option("MESH", command->mesh, "Closed triangle mesh: OBJ, OFF, PLY, STL, glTF, ...")->required();
  sub->add_option("--triangles", command->triangles, "Most triangles to keep")
      ->check(CLI::Range(4U, 1U << 30))
      ->capture_default_str();
  sub->add_option("-o,--output", command->output, "OBJ file to write")->required();
  sub->callback([command, &action] { action = [command] { return run(*command); }; });
}

}  // namespace cairn::tool
