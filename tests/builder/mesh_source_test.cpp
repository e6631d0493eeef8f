// SPDX-License-Identifier: GPL-3.0-or-later
//
// `cairn build --repair` and `--wrap` as a user meets them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "builder_meshes.h"
#include "run_program.h"

namespace cairn::builder::mesh_source_test {
namespace {

using Json = nlohmann::json;
using test::ProgramResult;

class MeshSource : public testing::Test {
 protected:
  void SetUp() override {
    TriangleMesh open = test::meshOf(test::cuboid({1, 1, 1}, 2));
    open.triangles.resize(open.triangles.size() - 8);
    std::swap(open.triangles[3][0], open.triangles[3][1]);
    test::writeText(path("open.obj"), test::objText(open));
    const TriangleMesh cube = test::meshOf(test::cuboid({1, 1, 1}, 1));
    const TriangleMesh shifted = test::moved(cube, [](const Vec3d& v) { return v + Vec3d{0.5, 0.4, 0.3}; });
    test::writeText(path("crossed.obj"), test::objText(test::joined(cube, shifted)));
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }
  ProgramResult build(const std::string& mesh, const std::string& more) const {
    return test::runProgram("cairn", "build " + quoted(mesh) + " -o " + quoted("out.cairn") +
                                         " --method octree --depth 2 --samples 500 --no-evaluate " + more);
  }
  Json json(const std::string& name) const { return Json::parse(test::contentOf(path(name))); }
  std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
  void expectRefused(const ProgramResult& result, int exitCode, const std::string& part) const {
    EXPECT_EQ(result.exitCode, exitCode);
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_EQ(fileCount(), 2U) << "something was left behind";
  }

  test::TemporaryFolder folder_;
};

TEST_F(MeshSource, AFaultyMeshIsRefusedWithTheWayOut) {
  expectRefused(build("open.obj", ""), 1, "try --repair or --wrap");
  expectRefused(build("crossed.obj", ""), 1, "try --repair or --wrap");
  // A fin on a cube: an edge of three triangles.
  test::writeText(path("crossed.obj"), test::objText(test::meshOf(test::cuboid({1, 1, 1}, 1))) + "v 2 2 2\nf 1 2 9\n");
  expectRefused(build("crossed.obj", "--mesh-output " + quoted("m.ply") + " --repair"), 1, "try --wrap");
}

TEST_F(MeshSource, RepairBuildsAndReportsWhatItDid) {
  const ProgramResult result =
      build("open.obj", "--repair --mesh-output " + quoted("mesh.ply") + " --json " + quoted("report.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("1 hole filled, 6 triangles added, 1 triangle turned"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("about the repaired mesh"), std::string::npos) << result.output;
  const Json report = json("report.json");
  EXPECT_EQ(report.at("certified_mesh"), "repaired");
  EXPECT_EQ(report.at("repair").at("filled_holes"), 1);
  EXPECT_EQ(report.at("repair").at("added_triangles"), 6);
  EXPECT_EQ(report.at("repair").at("turned_triangles"), 1);
  const ProgramResult proof = test::runProgram("cairn", "certify " + quoted("mesh.ply") + " " + quoted("out.cairn"));
  EXPECT_EQ(proof.exitCode, 0) << proof.errors;
  EXPECT_EQ(proof.errors, "") << "the tree knows the file";
}

TEST_F(MeshSource, RepairUnitesBodiesAndSaysSo) {
  const ProgramResult result = build("crossed.obj", "--repair --weld 1e-4 --json " + quoted("report.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("2 bodies united, 12 triangles cut where surfaces met"), std::string::npos)
      << result.output;
  const Json repair = json("report.json").at("repair");
  EXPECT_EQ(repair.at("weld_fraction"), 1e-4);
  EXPECT_EQ(repair.at("united_bodies"), 2);
  EXPECT_EQ(repair.at("cut_triangles"), 12);
  for (const char* none : {"moved_triangles", "closed_gaps", "enclosed_bodies", "folded_triangles", "thickened_edges"})
    EXPECT_EQ(repair.at(none), 0) << none;
}

TEST_F(MeshSource, WrapBuildsAndReportsTheErrorAgainstTheOriginal) {
  const ProgramResult result = build("crossed.obj", "--wrap --wrap-alpha 0.1 --wrap-offset 0.01 --mesh-output " +
                                                        quoted("skin.ply") + " --json " + quoted("report.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_NE(result.output.find("against the original surface"), std::string::npos) << result.output;
  const Json report = json("report.json");
  EXPECT_EQ(report.at("certified_mesh"), "wrap");
  const Json& wrap = report.at("wrap");
  EXPECT_EQ(wrap.at("alpha_fraction"), 0.1);
  EXPECT_EQ(wrap.at("offset_fraction"), 0.01);
  const double farthest = wrap.at("farthest_from_original_fraction");
  EXPECT_GT(farthest, 0.005);
  EXPECT_LE(wrap.at("farthest_from_original_at_least_fraction"), farthest);
  for (const Json& level : report.at("levels"))
    EXPECT_DOUBLE_EQ(level.at("original_max_fraction"), level.at("certified_max_fraction").get<double>() + farthest);
  const ProgramResult proof = test::runProgram("cairn", "certify " + quoted("skin.ply") + " " + quoted("out.cairn"));
  EXPECT_EQ(proof.exitCode, 0) << proof.errors;
  EXPECT_EQ(proof.errors, "") << "the tree knows the file";
}

TEST_F(MeshSource, WrapIsMadeAsNearAsAsked) {
  const ProgramResult result =
      build("crossed.obj", "--wrap --wrap-alpha 0.3 --wrap-error 0.02 --json " + quoted("report.json"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json wrap = json("report.json").at("wrap");
  EXPECT_LE(wrap.at("farthest_from_original_fraction").get<double>(), 0.02);
  EXPECT_LT(wrap.at("alpha_fraction").get<double>(), 0.3);
}

TEST_F(MeshSource, AGoodMeshIsReportedAsTheOriginal) {
  test::writeText(path("good.obj"), test::objText(test::lumpyBall(3, 1)));
  ASSERT_EQ(build("good.obj", "--json " + quoted("report.json")).exitCode, 0);
  const Json report = json("report.json");
  EXPECT_EQ(report.at("certified_mesh"), "original");
  EXPECT_FALSE(report.contains("repair"));
  EXPECT_FALSE(report.contains("wrap"));
}

TEST_F(MeshSource, ImpossibleOptionsAreWrongUsage) {
  expectRefused(build("open.obj", "--repair --wrap"), 2, "--wrap");
  expectRefused(build("open.obj", "--wrap-alpha 0.1"), 2, "--wrap");
  expectRefused(build("open.obj", "--weld 0.001"), 2, "--repair");
  expectRefused(build("open.obj", "--repair --weld 0.5"), 2, "--weld");
  expectRefused(build("open.obj", "--repair --weld nan"), 2, "--weld");
  expectRefused(build("open.obj", "--wrap --wrap-alpha 0"), 2, "--wrap-alpha");
  expectRefused(build("open.obj", "--wrap --wrap-alpha 1.5"), 2, "--wrap-alpha");
  expectRefused(build("open.obj", "--wrap --wrap-alpha nan"), 2, "--wrap-alpha");
  expectRefused(build("open.obj", "--wrap --wrap-offset 0.5"), 2, "--wrap-offset");
  expectRefused(build("open.obj", "--wrap --wrap-offset x"), 2, "--wrap-offset");
  expectRefused(build("open.obj", "--wrap --wrap-error 0"), 2, "--wrap-error");
  expectRefused(build("open.obj", "--wrap-error 0.01"), 2, "--wrap");
  expectRefused(build("open.obj", "--mesh-output " + quoted("m.ply")), 2, "--mesh-output");
  expectRefused(build("open.obj", "--wrap --mesh-output " + quoted("m.obj")), 2, ".ply");
}

TEST_F(MeshSource, TheMeshOutputIsCheckedBeforeTheWork) {
  expectRefused(build("open.obj", "--wrap --mesh-output " + quoted("no/m.ply")), 1, "does not exist");
  std::filesystem::rename(path("open.obj"), path("open.ply"));
  expectRefused(build("open.ply", "--wrap --mesh-output " + quoted("open.ply")), 1, "is the same file as");
}

}  // namespace
}  // namespace cairn::builder::mesh_source_test
