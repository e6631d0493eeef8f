// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "greatest.h"

// A million triangles, and hardly any spheres to spend on them.
//
//      .:::::::.               O        level 0: 1
//     :::::::::::      ->     O O       level 1: 2    (one child a node is refused)
//      ':::::::'             OO OO      level 2: 4
namespace cairn::hard {
namespace {

/// 8 n^2 triangles: a ball with smooth dents.
builder::TriangleMesh dentedBall(int n) {
  return test::moved(test::meshOf(test::ball(1, n)), [](const Vec3d& v) {
    return Vec3d(Vec3(v * (1 + 0.1 * std::sin(7 * v.x) * std::cos(5 * v.y) + 0.05 * std::sin(11 * v.z))));
  });
}

/// Megabytes this process has held at most since `forget`, more than it held then.
class PeakMemory {
 public:
  PeakMemory() {
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = of("VmRSS:");
  }
  double grown() const { return of("VmHWM:") - before_; }

 private:
  static double of(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (word == field) {
        double kilobytes = 0;
        status >> kilobytes;
        return kilobytes / 1024;
      }
    return 0;
  }
  double before_ = 0;
};

/// The most by which a level's certified error exceeds that of the level above. The errors are enclosed to 1 %.
Measure greatestRise(const char* name, const SphereTree& tree) {
  double rise = -100;
  for (std::uint32_t level = 1; level <= tree.depth(); ++level)
    rise = test::greatest(rise, 100 * (double(tree.levelError(level)) / double(tree.levelError(level - 1)) - 1));
  return {name, rise, 1, Bound::atMost, "% of it", "", 0};
}

void buildLarge(Effort effort, FamilyDemands& demands, Outcome& outcome) {
  const int n = effort == Effort::quick ? 36 : 354;  // 10 368 and 1 002 528 triangles
  const std::string bytes = builder::plyBytes(dentedBall(n));
  const auto mesh = demands.accepted(demands.import("large.ply", bytes));
  if (!mesh) return;
  const double millions = double(mesh->triangles.size()) / 1e6;
  builder::BuildOptions options;
  options.depth = demands.options().depth;
  const PeakMemory memory;
  const std::clock_t start = std::clock();
  const auto tree = demands.accepted(builder::buildTree(*mesh, options));
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;  // of all threads: other programs do not count
  if (!tree) return;
  outcome.measures.push_back({"build of " + std::to_string(mesh->triangles.size()) + " triangles", seconds,
                              10 + 50 * millions, Bound::atMost, "s of CPU", "", 0});
  outcome.measures.push_back(
      {"memory on top of the mesh", memory.grown(), 256 + 2048 * millions, Bound::atMost, "MB of it", "", 0});
  outcome.measures.push_back(greatestRise("greatest rise of the error from a level to the next", *tree));
}

Outcome runLargeAndStarved(Effort effort) {
  FamilyDemands demands(effort, 120);
  Outcome outcome;
  buildLarge(effort, demands, outcome);

  const builder::TriangleMesh small = dentedBall(effort == Effort::quick ? 3 : 20);
  builder::BuildOptions starved = demands.options();
  starved.branching = 1;
  demands.refuses(builder::buildTree(small, starved), "branching");
  starved.branching = 2;
  starved.depth = effort == Effort::quick ? 4 : 8;
  if (const auto tree = demands.build(small, starved))
    outcome.measures.push_back(greatestRise("two children: greatest rise from a level to the next", *tree));
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase largeAndStarved() {
  return {"G15", "a million triangles, two spheres a node",
          "errors fall from level to level, but for the 1 % they are certified to; time and memory bounded (proposed "
          "list), by 10 s of CPU and 256 MB and per "
          "million triangles 50 s and 2 GB more; one sphere a level is no tree, and refused",
          runLargeAndStarved};
}

}  // namespace cairn::hard
