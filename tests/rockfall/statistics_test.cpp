// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of many runs: shape decides how far rocks spread, and a mirrored release ends in mirrored stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "builder_meshes.h"
#include "built_trees.h"
#include "prepared_scene.h"
#include "rockfall/simulation/run.h"

namespace cairn::rockfall::statistics_test {
namespace {

using nlohmann::json;

constexpr std::uint64_t kRuns = 200;

Scene sceneIn(const json& document, const std::filesystem::path& folder) {
  TreeCache cache(test::treeFolder());
  auto description = parseCase(document.dump(), "case.json", folder);
  EXPECT_TRUE(description) << description.error().message;
  auto scene = prepareScene(std::move(description).value(), cache);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(scene).value();
}

/// Stopping places of the one rock of every run.
std::vector<Vec3d> stopsOf(const json& document, const std::filesystem::path& folder) {
  const Scene scene = sceneIn(document, folder);
  std::vector<Vec3d> stops;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    const auto finished = simulate(scene, run);
    EXPECT_TRUE(finished) << finished.error().message;
    stops.push_back(finished.value().result.rocks.front().end);
    EXPECT_NE(finished.value().result.rocks.front().ending, RockEnd::lost);
  }
  return stops;
}

/// One rock of about 780 kg down an even slope of soil that runs out on the level; `mesh` is a file of the folder.
json slopeCase(const std::string& mesh, double sieve) {
  json document = json::parse(R"({
    "case": "spread", "seed": 3, "step_s": 0.00833333, "duration_s": 25, "materials": ["stone", "soil"],
    "terrain": {"generated": "stepped_slope", "profile_m": [[0, 62], [10, 62], [90, 6], [110, 1], [200, 0]], "width_m": 300,
                "cell_m": 2, "roughness_m": 0.1, "material": "soil"},
    "rocks": [{"count": 1, "mesh": "", "sieve_m": {"sizes": [[1, 0], [1, 1]]}, "tree_depth": 3, "density_kg_per_m3": 2600,
               "material": "stone", "release": {"box_m": [[11, -1], [13, 1]], "above_ground_m": 1, "velocity_m_per_s": [4, 0, 0]}}],
    "effects": [{"effect": "friction", "default": 0.6}, {"effect": "restitution", "law": "constant", "default": 0.3},
                {"effect": "gyroscopic"}, {"effect": "sleeping", "linear_m_per_s": 0.2, "angular_rad_per_s": 0.3, "after_s": 1}],
    "outputs": {}})");
  document["rocks"][0]["mesh"] = mesh;
  document["rocks"][0]["sieve_m"]["sizes"] = json::array({json::array({sieve, 0.0}), json::array({sieve, 1.0})});
  return document;
}

double spread(const std::vector<Vec3d>& stops) {
  double mean = 0, square = 0;
  for (const Vec3d& stop : stops) mean += stop.y / static_cast<double>(stops.size());
  for (const Vec3d& stop : stops) square += (stop.y - mean) * (stop.y - mean);
  return std::sqrt(square / static_cast<double>(stops.size() - 1));
}

// The published field result (Caviezel et al. 2021): rocks like wheels spread wider than equant ones of the same mass.
TEST(Statistics_AWheel, SpreadsWiderThanAnEquantRockOfItsMass) {
  const test::TemporaryFolder folder;
  // Both of the mass of 0.3 m^3: a disc half as thick as it is wide, and a ball of 80 faces.
  const builder::TriangleMesh wheel = test::cylinder(0.5, 0.4, 24), equant = meshOf(test::ball(0.5, 1));
  test::writeText(folder.path() / "wheel.obj", test::objText(wheel));
  test::writeText(folder.path() / "equant.obj", test::objText(equant));
  constexpr double kVolume = 0.3;
  const auto sieveOf = [&](const builder::TriangleMesh& mesh) {
    const RockShape unit = measureRock(std::make_shared<const SphereTree>(test::quickTree(mesh)));
    return std::cbrt(kVolume / unit.volume);
  };
  const double wide = spread(stopsOf(slopeCase("wheel.obj", sieveOf(wheel)), folder.path()));
  const double narrow = spread(stopsOf(slopeCase("equant.obj", sieveOf(equant)), folder.path()));
  // The logarithm of a ratio of two variances of n values each has a standard error of about sqrt(4 / (n - 1)).
  const double ratio = wide / narrow, error = std::sqrt(1.0 / static_cast<double>(kRuns - 1));
  const double lower = ratio * std::exp(-1.96 * error), upper = ratio * std::exp(1.96 * error);
  std::printf("lateral spread over %d runs: wheel %.2f m, equant %.2f m, ratio %.2f (95 %%: %.2f to %.2f)\n",
              static_cast<int>(kRuns), wide, narrow, ratio, lower, upper);
  EXPECT_GT(lower, 1) << "wider with 97.5 % confidence";
}

/// Two-sample Kolmogorov-Smirnov: the chance of at least this distance if both were drawn from one distribution.
double sameDistribution(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double distance = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    (a[i] <= b[j] ? i : j) += 1;
    distance = std::max(distance, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                           static_cast<double>(j) / static_cast<double>(b.size())));
  }
  const double n = static_cast<double>(a.size() * b.size()) / static_cast<double>(a.size() + b.size());
  const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += 2 * (k % 2 == 1 ? 1 : -1) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

TEST(Statistics_TwoSamples, AreToldApartWhenTheyDiffer) {
  std::vector<double> a, b, c;
  for (int i = 0; i < 200; ++i) {
    a.push_back(i);
    b.push_back(i + 0.5);
    c.push_back(i + 60);
  }
  EXPECT_GT(sameDistribution(a, b), 0.9);
  EXPECT_LT(sameDistribution(a, c), 1e-6);
}

TEST(Statistics_AMirroredRelease, EndsInMirroredStops) {
  json document = json::parse(R"({
    "case": "mirror", "seed": 5, "step_s": 0.00833333, "duration_s": 25, "materials": ["stone", "soil"],
    "terrain": {"generated": "channel", "length_m": 120, "width_m": 60, "slope_deg": 25, "depth_m": 12, "cell_m": 2,
                "roughness_m": 0.1, "material": "soil"},
    "rocks": [{"count": 1, "make": {"kind": "angular", "variants": 5}, "sieve_m": {"sizes": [[0.8, 0], [1, 1]]}, "tree_depth": 2,
               "density_kg_per_m3": 2600, "material": "stone", "release": {"box_m": [[4, 8], [8, 12]], "above_ground_m": 1}}],
    "effects": [{"effect": "friction", "default": 0.6}, {"effect": "restitution", "law": "constant", "default": 0.3},
                {"effect": "sleeping", "linear_m_per_s": 0.2, "angular_rad_per_s": 0.3, "after_s": 1}],
    "outputs": {}})");
  const std::vector<Vec3d> left = stopsOf(document, ".");
  document["rocks"][0]["release"]["box_m"] = json::parse("[[4, -12], [8, -8]]");
  document["seed"] = 6;  // other rocks at other places, so that the samples are independent
  const std::vector<Vec3d> right = stopsOf(document, ".");
  std::vector<double> x0, y0, x1, y1;
  for (const Vec3d& stop : left) x0.push_back(stop.x), y0.push_back(stop.y);
  for (const Vec3d& stop : right) x1.push_back(stop.x), y1.push_back(-stop.y);
  const double along = sameDistribution(x0, x1), across = sameDistribution(y0, y1);
  std::printf("mirrored stops: p %.3f along, %.3f across\n", along, across);
  EXPECT_GT(along, 0.01);
  EXPECT_GT(across, 0.01);
}

}  // namespace
}  // namespace cairn::rockfall::statistics_test
