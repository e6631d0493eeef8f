// SPDX-License-Identifier: GPL-3.0-or-later
//
// Trees that follow moving meshes: what a refit costs, and how much wider its errors are than those of a tree built
// anew for the moved mesh. CPU time, one thread.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/core/tree_refit.h"
#include "cpu_seconds.h"
#include "moving_meshes.h"

namespace cairn {
namespace {

using bench::cpuSeconds;

struct Options {
  int fineness = 4, refits = 200, phases = 4;
  std::uint32_t depth = 3;
};

// What cannot be had ends the program.
template <class T>
T orEnd(Result<T> result) {
  if (result) return std::move(result).value();
  fmt::print(stderr, "moving_bench: {}\n", result.error().message);
  std::exit(1);
}

std::shared_ptr<const SphereTree> built(const builder::TriangleMesh& mesh, std::uint32_t depth) {
  builder::BuildOptions options;
  options.depth = depth;
  return std::make_shared<const SphereTree>(orEnd(builder::buildTree(mesh, options)));
}

double meanLeafError(const SphereTree& tree) {
  double sum = 0;
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record)
    if (tree.isLeaf(tree.nodeAt(record))) sum += double(tree.data().nodes[record].error);
  return sum / tree.leafCount();
}

void row(const test::MovingMesh& mesh, const Options& options) {
  const auto tree = built(test::meshOf(mesh.first), options.depth);
  double start = cpuSeconds();
  TreeRefit refit = orEnd(TreeRefit::bind(tree));
  const double binding = cpuSeconds() - start;
  const double unmoved = meanLeafError(*orEnd(refit.refit(tree->vertices()))) / meanLeafError(*tree);
  double refitted = 0, rebuilt = 0;
  for (int i = 0; i < options.phases; ++i) {
    const double phase = 2 * std::numbers::pi * (i + 0.5) / options.phases;
    refitted += meanLeafError(*orEnd(refit.refit(mesh.inTree(*tree, phase))));
    builder::TriangleMesh moved = test::meshOf(mesh.first);
    moved.vertices = mesh.at(phase);
    rebuilt += meanLeafError(*built(moved, options.depth));
  }
  std::vector<std::vector<Vec3>> steps;
  for (int i = 0; i < 8; ++i) steps.push_back(mesh.inTree(*tree, 0.02 * i));
  start = cpuSeconds();
  for (int i = 0; i < options.refits; ++i) orEnd(refit.refit(steps[static_cast<std::size_t>(i) % steps.size()]));
  const double perRefit = (cpuSeconds() - start) / options.refits;
  fmt::print("{:<16}{:>9}{:>7}{:>9.0f}{:>10.2f}{:>11.0f}{:>10.2f}{:>10.2f}\n", mesh.name, tree->vertices().size(),
             tree->nodeCount(), 1e3 * binding, 1e3 * perRefit,
             1e9 * perRefit / static_cast<double>(tree->vertices().size()), unmoved, refitted / rebuilt);
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app("What it costs a tree to follow a moving mesh, and how tight it stays.", "moving_bench");
  Options options;
  app.add_option("--fineness", options.fineness, "Of the meshes: vertices go with its square")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_option("--depth", options.depth, "Levels of the trees below the root")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  app.add_option("--refits", options.refits, "Refits that are timed")->check(CLI::Range(1, 1000000));
  app.add_option("--phases", options.phases, "Trees built anew for each motion")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  fmt::print("                                           ms          ns a vertex   leaf error over that of the tree\n");
  fmt::print("motion           vertices  nodes     bind     refit     refit     unmoved   built anew\n");
  row(test::bendingBar(4 * options.fineness), options);
  row(test::breathingBall(4 * options.fineness), options);
  row(test::walkingFigure(options.fineness / 2 + 1), options);
}
