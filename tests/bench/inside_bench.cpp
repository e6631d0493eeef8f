// SPDX-License-Identifier: GPL-3.0-or-later
//
// Queries per second of the inside tests on one mesh in one run, one thread, CPU time. Ends with 1 when a test that is
// said to be right differs from the signed distance.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <vector>

#include "cairn/builder/import.h"
#include "cpu_seconds.h"
#include "surface/icosphere.h"
#include "surface/inside_by_closest_point.h"
#include "surface/inside_by_crossings.h"
#include "surface/inside_by_grid.h"
#include "surface/random_stream.h"
#include "surface/signed_distance.h"

namespace cairn::builder {
namespace {

using bench::cpuSeconds;

struct Queries {
  std::vector<Vec3d> inBox, nearSurface;  // within 2 % of the diagonal of the surface
};

Queries queriesFor(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  const Bounds bounds = boundsOf(mesh);
  const Vec3d extent = bounds.upper - bounds.lower;
  Queries queries;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    queries.inBox.push_back(bounds.lower + Vec3d{x * extent.x, y * extent.y, z * extent.z});
    const auto t = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(mesh.triangles.size()));
    const auto c = mesh.corners(t);
    queries.nearSurface.push_back(random.inBall((c[0] + c[1] + c[2]) / 3, 0.02 * bounds.diagonal()));
  }
  return queries;
}

using Test = std::function<bool(const Vec3d&)>;

/// The best of three runs.
double queriesPerSecond(const std::vector<Vec3d>& queries, const Test& test) {
  double best = 0;
  for (int run = 0; run < 3; ++run) {
    const double start = cpuSeconds();
    std::size_t insiders = 0;
    for (const Vec3d& q : queries) insiders += test(q) ? 1 : 0;
    // The count is used, so that nothing is left out.
    if (insiders <= queries.size())
      best = std::max(best, static_cast<double>(queries.size()) / (cpuSeconds() - start + 1e-9));
  }
  return best;
}

struct Bench {
  const SignedDistance& solid;
  Queries queries;

  std::size_t wrong(const Test& test) const {
    std::size_t count = 0;
    for (const auto* set : {&queries.inBox, &queries.nearSurface})
      for (const Vec3d& q : *set) {
        const double depth = solid.depth(q);
        count += std::abs(depth) > solid.roundingBound(q) && test(q) != (depth > 0) ? 1 : 0;
      }
    return count;
  }

  /// Returns whether no answer was wrong. `make` builds what the test needs.
  template <class Make>
  bool row(const char* name, const Make& make) const {
    const double start = cpuSeconds();
    const auto built = make();
    const double buildMs = 1e3 * (cpuSeconds() - start);
    const Test test = [&](const Vec3d& q) { return built.inside(q); };
    const std::size_t mistakes = wrong(test);
    fmt::print("{:<34} {:9.1f} {:12.0f} {:14.0f} {:7}\n", name, buildMs, queriesPerSecond(queries.inBox, test),
               queriesPerSecond(queries.nearSurface, test), mistakes);
    return mistakes == 0;
  }
};

struct BySignedDistance {
  SignedDistance solid;
  bool inside(const Vec3d& p) const { return solid.depth(p) > 0; }
};

int run(const TriangleMesh& mesh, std::size_t count, std::uint32_t perSide, std::uint64_t seed) {
  const SignedDistance solid(mesh);
  const InsideByClosestPoint closest(mesh, perSide);
  const InsideByCrossings crossings(mesh, perSide);
  const Bench bench{solid, queriesFor(mesh, count, seed)};
  fmt::print("{}: {} triangles, {} queries of each kind, seed {}, one thread\n", mesh.name, mesh.triangles.size(),
             count, seed);
  fmt::print("                                    build ms    in box /s  near surface /s   wrong\n");
  const auto grid = [&](Test test) { return InsideByGrid(mesh, std::move(test), perSide); };
  bool right = bench.row("signed distance (the builder's)", [&] { return BySignedDistance{SignedDistance(mesh)}; });
  // The closest-point test may be wrong at corners; its header says so.
  bench.row("closest point, voxels (A.1)", [&] { return InsideByClosestPoint(mesh, perSide); });
  right &= bench.row("crossings, voxels (A.2)", [&] { return InsideByCrossings(mesh, perSide); });
  right &= bench.row("grid, then signed distance (A.3)",
                     [&] { return grid([&](const Vec3d& p) { return solid.depth(p) > 0; }); });
  bench.row("grid, then closest point", [&] { return grid([&](const Vec3d& p) { return closest.inside(p); }); });
  right &= bench.row("grid, then crossings", [&] { return grid([&](const Vec3d& p) { return crossings.inside(p); }); });
  return right ? 0 : 1;
}

}  // namespace
}  // namespace cairn::builder

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app("Queries per second of the inside tests on one mesh.\n\n  inside_bench bunny.obj", "inside_bench");
  std::string file;
  std::size_t count = 200'000;
  std::uint32_t perSide = 0;
  std::uint64_t seed = 1;
  app.add_option("MESH", file, "Closed triangle mesh; an icosphere of 1280 triangles when left out");
  app.add_option("--queries", count, "Of each kind")->check(CLI::Range(1, 100'000'000))->capture_default_str();
  app.add_option("--per-side", perSide, "Voxels along the longest side; 0 fits them to the triangles")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.add_option("--seed", seed, "Of the queries")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (file.empty()) {
    builder::TriangleMesh sphere = builder::unitIcosphere(3);
    sphere.name = "icosphere";
    return builder::run(sphere, count, perSide, seed);
  }
  const auto mesh = builder::importMesh(file);
  if (!mesh) {
    fmt::print(stderr, "inside_bench: {}\n", mesh.error().message);
    return 1;
  }
  return builder::run(mesh.value(), count, perSide, seed);
}
