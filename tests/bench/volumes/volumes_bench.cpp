// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spheres against spheres, capsules, slabs and boxes mixed (thesis 8.3.6): volumes, certified error and traversal time
// at equal error. One thread, CPU time, medians of interleaved runs.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "cairn/builder/import.h"
#include "volumes/measure.h"

namespace cairn::bench {
namespace {

struct Options {
  std::string mesh, only;
  std::size_t mostSameParts = 1000;
  bool allSets = false;
  MeasureOptions measure;
};

constexpr std::array<const char*, kVolumeKinds> kKindNames{"ball", "capsule", "slab", "box"};

std::vector<KindSet> setsOf(const Options& options) {
  const VolumeKind ball = VolumeKind::ball, capsule = VolumeKind::capsule, slab = VolumeKind::slab,
                   box = VolumeKind::box;
  std::vector<KindSet> sets{{"spheres", {ball}}, {"mixed", {ball, capsule, slab, box}}};
  if (options.allSets)
    sets.insert(sets.end(),
                {{"swept", {ball, capsule, slab}}, {"and capsules", {ball, capsule}}, {"and boxes", {ball, box}}});
  return sets;
}

void printCosts(const MeasureOptions& options) {
  const PairCosts costs = measurePairCosts(options);
  fmt::print("One volume moved and tested against another, ns (plain balls: {:.1f}); costs that choices go by: {}\n",
             costs.plainBalls, fmt::join(kPairCost, ", "));
  fmt::print("{:<9}", "");
  for (const char* name : kKindNames) fmt::print("{:>9}", name);
  for (std::size_t a = 0; a < kVolumeKinds; ++a) {
    fmt::print("\n{:<9}", kKindNames[a]);
    for (std::size_t b = 0; b < kVolumeKinds; ++b) fmt::print("{:9.1f}", costs.ofKinds[a][b]);
  }
  fmt::print("\n");
}

void printSameParts(const NamedMesh& named, const Options& options) {
  const auto rows = compareOnSameParts(named, options.measure.errorPercents, options.mostSameParts);
  fmt::print("Parts of the spheres' tree, and the certified error of each kind around them, % of the diagonal\n");
  fmt::print("                  ball           capsule            slab             box           best at equal cost\n");
  fmt::print(
      "error %  parts   worst    mean   worst    mean   worst    mean   worst    mean   balls capsules slabs boxes\n");
  for (const SameParts& row : rows) {
    fmt::print("{:7}{:7}", row.errorPercent, row.parts);
    for (std::size_t k = 0; k < kVolumeKinds; ++k) fmt::print("{:8.3f}{:8.3f}", row.worst[k], row.mean[k]);
    fmt::print("{:8}{:9}{:6}{:6}\n", row.chosen[0], row.chosen[1], row.chosen[2], row.chosen[3]);
  }
}

void printSet(const Comparison& c, const KindSet& set, std::size_t s) {
  fmt::print("{}, grown in {:.1f} s\n", set.name, c.growSeconds[s]);
  fmt::print(
      "error %   nodes   balls capsules slabs boxes     KiB   pairs     tests operations        us   to spheres: nodes "
      "   "
      "time  keep\n");
  for (std::size_t i = 0; i < c.sets[s].size(); ++i) {
    const AtError &row = c.sets[s][i], &spheres = c.sets[0][i];
    fmt::print("{:7}{:8}{:8}{:9}{:6}{:6}{:8.1f}{:8.1f}{:10.0f}{:11.0f}{:10.2f}", row.errorPercent, row.allNodes(),
               row.nodes[0], row.nodes[1], row.nodes[2], row.nodes[3], static_cast<double>(row.bytes) / 1024, row.pairs,
               row.tests, row.operations, row.microseconds);
    if (s > 0)
      fmt::print("{:20.4f}{:8.3f}  {}", static_cast<double>(row.allNodes()) / static_cast<double>(spheres.allNodes()),
                 row.microseconds / spheres.microseconds, isWorthKeeping(row, spheres) ? "mixed" : "spheres");
    fmt::print("{}\n", row.isReached ? "" : "  not reached");
  }
}

void printInterrupted(const Comparison& c, const std::vector<KindSet>& sets, const MeasureOptions& options) {
  fmt::print("Interrupted: worst certified error of a pair, % of the diagonal, after tests that cost\n{:<9}", "");
  for (const double cost : options.costs) fmt::print("{:>9}", cost);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    fmt::print("\n{:<9}", sets[s].name);
    for (const double error : c.interrupted[s]) fmt::print("{:9.2f}", error);
  }
  fmt::print("\n");
}

void compare(const NamedMesh& named, const Options& options) {
  const std::vector<KindSet> sets = setsOf(options);
  const Comparison c = compareSets(named, sets, options.measure);
  fmt::print("\n{} ({} triangles)\n", c.name, c.triangles);
  for (std::size_t s = 0; s < sets.size(); ++s) printSet(c, sets[s], s);
  printInterrupted(c, sets, options.measure);
  printSameParts(named, options);
  fflush(stdout);
}

int run(const Options& options) {
  std::vector<NamedMesh> meshes = generatedSolids();
  if (!options.mesh.empty()) {
    Result<builder::TriangleMesh> mesh = builder::importMesh(options.mesh);
    if (!mesh) {
      fmt::print(stderr, "volumes_bench: {}\n", mesh.error().message);
      return 1;
    }
    meshes.push_back({std::filesystem::path(options.mesh).stem().string(), std::move(mesh).value()});
  }
  double load = 0;
  (void)getloadavg(&load, 1);
  fmt::print(
      "one thread, CPU time, median of {} runs; {} poses that touch; seed {}; load of the machine {:.1f} on {} CPUs\n",
      options.measure.runs, options.measure.poses, options.measure.seed, load, sysconf(_SC_NPROCESSORS_ONLN));
  printCosts(options.measure);
  for (const NamedMesh& named : meshes)
    if (options.only.empty() || named.name.starts_with(options.only)) compare(named, options);
  return 0;
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  using namespace cairn::bench;
  CLI::App app("Volumes, certified error and traversal time at equal error: spheres against mixed volumes.",
               "volumes_bench");
  Options options;
  app.add_option("MESH", options.mesh, "A closed mesh to compare on, after the generated ones");
  app.add_option("--only", options.only, "Only meshes whose name begins so");
  app.add_option("--errors", options.measure.errorPercents, "Certified errors, per cent of the mesh's diagonal")
      ->check(CLI::Range(0.05, 50.0))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--poses", options.measure.poses, "Random poses in which two bodies touch")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--runs", options.measure.runs, "Of which the median is printed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--run-ms", options.measure.runMs, "Least length of a run")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  app.add_option("--most-parts", options.mostSameParts, "Of the spheres' tree that all kinds are fitted to")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_flag("--all-sets", options.allSets,
               "Also spheres with capsules and slabs, with capsules alone and with boxes alone");
  app.add_option("--seed", options.measure.seed, "Of the poses")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return run(options);
}
