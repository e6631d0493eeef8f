// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pieces that fit with a little play: whether they go together, hold and come apart as pieces do, as sphere-trees and
// as Bullet's own concave shape.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>

#include "fits.h"

int main(int argc, char** argv) {
  using namespace cairn::bench;
  CLI::App app("How pieces that fit behave in a simulation, each scene with what is right.", "fits_bench");
  std::string folder;
  std::vector<std::string> only;
  bool withPeers = false;
  app.add_option("FOLDER", folder, "Where the pieces' meshes are")->required()->check(CLI::ExistingDirectory);
  app.add_option("--only", only, "Scenes to run, by name")->delimiter(',');
  app.add_flag("--peers", withPeers, "GImpact too");
  CLI11_PARSE(app, argc, argv);
  try {
    Pieces pieces(folder);
    std::vector<FitShape> shapes{FitShape::tree, FitShape::treeLeaves, FitShape::treeOnMesh};
    if (withPeers) shapes.push_back(FitShape::gimpact);
    for (const Fit& fit : fits()) {
      if (!only.empty() && std::ranges::find(only, fit.name) == only.end()) continue;
      for (const FitShape shape : shapes) {
        const FitResult result = fit.run(pieces, shape);
        fmt::print("{:18} {:15} {:5} {}\n", result.name, nameOf(shape), result.holds ? "holds" : "FAILS",
                   result.figures);
        std::fflush(stdout);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "fits_bench: {}\n", error.what());
    return 1;
  }
}
