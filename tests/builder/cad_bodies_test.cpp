// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies as CAD programs export them: overlapping, touching, apart by a little. `repair` makes one solid of them,
// judged by formulas and winding numbers.
#include "cad_bodies.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "distance_oracle.h"
#include "run_program.h"

namespace cairn::builder::cad_bodies_test {
namespace {

using test::CadCase;

/// Vertices are rounded to floats: planes move by no more than this part of the size.
constexpr double kRounding = 0x1p-22;

/// As it is, and turned and moved so that no plane of it keeps its place when rounded.
struct Pose {
  const char* name;
  Vec3d x, y, z, shift;
  Vec3d operator()(const Vec3d& p) const { return x * p.x + y * p.y + z * p.z + shift; }
  bool isTurned() const { return !(shift == Vec3d()); }
};

std::vector<Pose> poses() {
  const Vec3d x = normalized(Vec3d{0.48, 0.61, -0.63}), y = normalized(cross(Vec3d{0.3, -0.2, 0.9}, x));
  return {{"AsItIs", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}, {"Turned", x, y, cross(x, y), {0.37, -1.9, 0.71}}};
}

class CadBodies : public testing::TestWithParam<std::tuple<CadCase, Pose>> {
 protected:
  const CadCase& given() const { return std::get<0>(GetParam()); }
  const Pose& pose() const { return std::get<1>(GetParam()); }
  TriangleMesh posed() const { return test::moved(given().mesh, pose()); }
};

double volumeOf(const TriangleMesh& mesh) {
  long double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    sum += static_cast<long double>(dot(c[0], cross(c[1], c[2]))) / 6;
  }
  return static_cast<double>(sum);
}

double areaOf(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    sum += length(cross(c[1] - c[0], c[2] - c[0])) / 2;
  }
  return sum;
}

std::size_t shellCount(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> leader(mesh.vertices.size());
  for (std::uint32_t v = 0; v < leader.size(); ++v) leader[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v];
    return v;
  };
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) leader[find(v)] = find(t[0]);
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < leader.size(); ++v) count += leader[v] == v;
  return count;
}

TEST_P(CadBodies, BecomeTheirUnion) {
  RepairCounts counts;
  const Result<TriangleMesh> result = repair(posed(), &counts);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const TriangleMesh& mesh = result.value();
  ASSERT_TRUE(checkMesh(mesh).ok());
  EXPECT_EQ(shellCount(mesh), given().shells) << counts.text();
  const double size = test::sizeOf(given().mesh);
  const double rounding = kRounding * size * size * size;
  EXPECT_GE(volumeOf(mesh), given().volume - rounding) << counts.text();
  // Turned faces coincide but for rounding; those of the smaller body move, by less than twice the weld.
  const double moved =
      pose().isTurned() && counts.movedTriangles > 0 ? areaOf(given().mesh) * 2 * test::kWeldOfCad * size : 0;
  EXPECT_LE(volumeOf(mesh), given().volume + given().slack + moved + rounding) << counts.text();
}

TEST_P(CadBodies, LoseNoPoint) {
  const Result<TriangleMesh> result = repair(posed());
  ASSERT_TRUE(result.ok()) << result.error().message;
  const test::DistanceOracle oracle{result.value()};
  const Bounds bounds = boundsOf(given().mesh);
  const double size = test::sizeOf(given().mesh), moved = 2 * test::kWeldOfCad * size;
  constexpr std::uint64_t kSeed = 3;
  std::mt19937_64 engine(kSeed);
  int inside = 0, outside = 0;
  for (int i = 0; i < 1500; ++i) {
    Vec3d p = bounds.center();
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += test::uniform(engine, -0.55, 0.55) * (bounds.upper[axis] - bounds.lower[axis]);
    const bool isSolid = given().isSolid(p);
    (isSolid ? inside : outside) += 1;
    const Vec3d q = pose()(p);
    if ((oracle.windingNumber(q) > 0.5) == isSolid) continue;
    EXPECT_LE(oracle.distance(q), isSolid ? kRounding * size : moved) << "seed " << kSeed << ", point " << i;
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST_P(CadBodies, EndAsOneProvedTree) {
  const test::TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  test::writeText(path("bodies.obj"), test::objText(posed()));
  const auto built = test::runProgram("cairn", "build '" + path("bodies.obj") + "' -o '" + path("out.cairn") +
                                                   "' --repair --method octree --depth 2 --samples 500 --no-evaluate "
                                                   "--mesh-output '" +
                                                   path("mesh.ply") + "' --json '" + path("report.json") + "'");
  ASSERT_EQ(built.exitCode, 0) << built.errors;
  const auto report = nlohmann::json::parse(test::contentOf(path("report.json")));
  for (const auto& level : report.at("levels")) EXPECT_TRUE(level.at("coverage_proven")) << built.output;
  const auto proof = test::runProgram("cairn", "certify '" + path("mesh.ply") + "' '" + path("out.cairn") + "'");
  EXPECT_EQ(proof.exitCode, 0) << proof.errors;
  if (!pose().isTurned()) EXPECT_NE(built.output.find(given().did), std::string::npos) << built.output;
}

std::string nameOf(const testing::TestParamInfo<std::tuple<CadCase, Pose>>& info) {
  return std::get<0>(info.param).name + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(All, CadBodies,
                         testing::Combine(testing::ValuesIn(test::cadCases()), testing::ValuesIn(poses())), nameOf);

TriangleMesh box(const Vec3d& lower, const Vec3d& upper) {
  return test::moved(test::meshOf(test::cuboid(upper - lower, 1)),
                     [&](const Vec3d& v) { return v + (lower + upper) * 0.5; });
}

// The unit of floats is 3 cm at x, and half a micrometre at z.
TEST(BodiesFarAway, KeepWhatIsThinAlongAnotherAxis) {
  const double x = 500000;
  const TriangleMesh house = test::joined(box({x, 0, 0}, {x + 10, 8, 3}), box({x + 9, 2, 0}, {x + 14, 6, 2.5}));
  const TriangleMesh roof = box({x - 1, -1, 6.005}, {x + 11, 9, 6.015});
  const Result<TriangleMesh> solid = repair(test::joined(house, roof));
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_EQ(boundsOf(solid.value()).upper.z, double(6.015F));
  EXPECT_NEAR(volumeOf(solid.value()), 240 + 4 * 4 * 2.5 + 12 * 10 * 0.01, 1);
}

TEST(BodiesFarAway, ThatAreLostAreTold) {
  const TriangleMesh large = test::joined(box({0, 0, 0}, {2e7, 2e7, 2e7}), box({1e7, 1e7, 1e7}, {3e7, 3e7, 3e7}));
  const Result<TriangleMesh> solid =
      repair(test::joined(large, box({-10.4, -10.4, -10.4}, {-10.2, -10.2, -10.2})), nullptr, {.weld = 0});
  ASSERT_FALSE(solid.ok());
  EXPECT_NE(solid.error().message.find("leaves nothing of its body near (-10."), std::string::npos)
      << solid.error().message;
}

// Beads around edges have many triangles, cubes few.
TEST(TouchingCubes, AreJoinedInEveryEdge) {
  TriangleMesh cubes;
  for (const Vec3d& at : {Vec3d(0, 0, 0), Vec3d(1, 1, 0), Vec3d(1, 0, 1), Vec3d(0, 1, 1)})
    cubes = test::joined(cubes, box(at, at + Vec3d(1, 1, 1)));
  RepairCounts counts;
  const Result<TriangleMesh> solid = repair(cubes, &counts);
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_GE(counts.beadedEdges, 6U);
  EXPECT_NEAR(volumeOf(solid.value()), 4, 4e-3);
}

}  // namespace
}  // namespace cairn::builder::cad_bodies_test
