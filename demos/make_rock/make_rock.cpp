// SPDX-License-Identifier: GPL-3.0-or-later
// make_rock writes a concave rock as an OBJ file, for users without a mesh.
#include <CLI/CLI.hpp>
#include <string>

#include "cairn/builder/simplify.h"
#include "cairn/core/atomic_file.h"
#include "scenes/bodies/rock.h"
#include "scenes/command/program.h"

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app("Writes a concave, closed rock about 1 unit across.\n\n  make_rock --seed 7 -o rock.obj", "make_rock");
  scenes::RockOptions options;
  std::string file;
  app.add_option("--seed", options.seed, "which rock")->check(scenes::refuseNoWholeNumber)->capture_default_str();
  app.add_option("--subdivisions", options.subdivisions, "20 * 4^n triangles")
      ->check(CLI::Range(1U, 6U))
      ->capture_default_str();
  app.add_option("-o,--output", file, "the OBJ file to write")->required();
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  const Status status = writeFileAtomically(file, builder::objText(scenes::generateRock(options)));
  return status ? scenes::kExitDone : scenes::refuse("make_rock", status.error());
}
