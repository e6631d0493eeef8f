// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/core/tree_file.h"
#include "case_documents.h"
#include "rockfall/rocks/rock_maker.h"
#include "rockfall/rocks/rock_stock.h"
#include "run_program.h"
#include "scenes/bodies/icosphere.h"

namespace cairn::rockfall::rocks_test {
namespace {

constexpr std::array kKinds{RockKind::angular, RockKind::slabby, RockKind::rounded};

builder::BuildOptions quickBuild() {
  builder::BuildOptions options;
  options.depth = 1;
  options.samples = 300;
  return options;
}

/// Greatest distance of a vertex beyond the plane of a face: 0 for convex bodies, up to rounding.
double worstBulge(const builder::TriangleMesh& mesh) {
  double worst = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const Vec3d normal = normalized(cross(b - a, c - a));
    for (const Vec3d& v : mesh.vertices) worst = std::max(worst, dot(normal, v - a));
  }
  return worst;
}

TEST(Rocks_OfEveryKind, AreSolidsThatTheBuilderTakes) {
  for (const RockKind kind : kKinds)
    for (const bool concave : {false, true})
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const auto mesh = makeRock(kind, concave, seed);
        const Status checked = builder::checkMesh(mesh);
        EXPECT_TRUE(checked) << mesh.name << ": " << checked.error().message;
      }
}

TEST(Rocks_OfEveryKind, AreConcaveOnlyOnRequest) {
  for (const RockKind kind : kKinds)
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      // Facets of a body one unit long, planes through doubles: a hundred times their rounding.
      EXPECT_LT(worstBulge(makeRock(kind, false, seed)), 1e-13);
      EXPECT_GT(worstBulge(makeRock(kind, true, seed)), 0.05) << "the dents are at least a tenth of the radius deep";
    }
}

TEST(Rocks_SameSeed, GivesTheSameBits) {
  const auto one = makeRock(RockKind::angular, true, 7), two = makeRock(RockKind::angular, true, 7);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_NE(makeRock(RockKind::angular, true, 8).vertices, one.vertices);
}

TEST(Rocks_Slabs, AreFlatAndTheOthersAreNot) {
  const test::TemporaryFolder folder;
  TreeCache cache(folder.path());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto ratioOf = [&](RockKind kind) {
      return measureRock(cache.obtain(makeRock(kind, false, seed), quickBuild()).value()).inertiaRatio;
    };
    // Of an ellipsoid with half axes 1 > b > c it is (1 + b^2) / (b^2 + c^2): at least 1.64 for c = 0.4 b and b = 0.95,
    // at most 1.68 for c = 0.8 b and b = 0.72; facets change it by a tenth or two.
    EXPECT_GT(ratioOf(RockKind::slabby), 1.5);
    EXPECT_LT(ratioOf(RockKind::rounded), 1.8);
  }
}

TEST(Rocks_SieveSize, IsTheMiddleExtent) {
  builder::TriangleMesh ball = scenes::icosphere(3);
  for (Vec3d& v : ball.vertices) v = {v.x * 3, v.y * 1, v.z * 2};
  TreeCache cache({});
  const RockShape shape = measureRock(cache.obtain(ball, quickBuild()).value());
  // The icosphere's corners stand up to 1 % off the axes; all is measured from them.
  EXPECT_NEAR(1 / shape.scale, 4, 0.04);
  EXPECT_NEAR(shape.reach, 0.75, 0.01);
  EXPECT_NEAR(shape.inertiaRatio, (9 + 4) / (4 + 1.0), 0.02);
  // Half axes 0.75, 0.5 and 0.25 m; three subdivisions lose 1 % of a ball's volume.
  EXPECT_NEAR(shape.volume, 4.0 / 3 * 3.14159 * 0.75 * 0.5 * 0.25, 0.02 * 0.39);
}

TEST(TreeCache_ATree, IsBuiltOnceAndLoadedAfterwards) {
  const test::TemporaryFolder folder;
  const auto mesh = makeRock(RockKind::slabby, true, 1);
  TreeCache first(folder.path()), second(folder.path());
  const auto built = first.obtain(mesh, quickBuild()).value();
  const auto loaded = second.obtain(mesh, quickBuild()).value();
  EXPECT_EQ(first.built(), 1U);
  EXPECT_EQ(second.built(), 0U);
  EXPECT_EQ(second.loaded(), 1U);
  EXPECT_EQ(encodeTree(*built), encodeTree(*loaded));
}

TEST(TreeCache_FileName, DependsOnMeshAndOptions) {
  auto mesh = makeRock(RockKind::slabby, true, 1);
  const auto name = TreeCache::fileName(mesh, quickBuild());
  builder::BuildOptions other = quickBuild();
  other.threads = 2;
  EXPECT_EQ(TreeCache::fileName(mesh, other), name) << "the tree does not depend on it";
  other.depth = 2;
  EXPECT_NE(TreeCache::fileName(mesh, other), name);
  mesh.vertices[3].x += 1e-15;
  EXPECT_NE(TreeCache::fileName(mesh, quickBuild()), name);
}

TEST(TreeCache_ABrokenFile, IsBuiltAnewAndReplaced) {
  const test::TemporaryFolder folder;
  const auto mesh = makeRock(RockKind::slabby, true, 1);
  const auto file = folder.path() / TreeCache::fileName(mesh, quickBuild());
  TreeCache cache(folder.path());
  ASSERT_TRUE(cache.obtain(mesh, quickBuild()));
  const std::string good = test::contentOf(file);
  std::string broken = good;
  broken[broken.size() / 2] = static_cast<char>(broken[broken.size() / 2] ^ 1);
  std::ofstream(file, std::ios::binary) << broken;
  ASSERT_TRUE(cache.obtain(mesh, quickBuild()));
  EXPECT_EQ(cache.built(), 2U);
  EXPECT_EQ(test::contentOf(file), good);
}

TEST(TreeCache_AFolderThatCannotBe, IsToldAndHindersNothing) {
  TreeCache cache("/proc/nowhere");
  ASSERT_TRUE(cache.obtain(makeRock(RockKind::slabby, false, 1), quickBuild()));
  ASSERT_TRUE(cache.complaint());
  EXPECT_NE(cache.complaint()->message.find("/proc/nowhere"), std::string::npos);
}

TEST(Rocks_Stock, HasEveryVariantOfEveryGroup) {
  nlohmann::json document = test::plainCase();
  document["rocks"][0]["make"]["variants"] = 2;
  document["rocks"].push_back(document["rocks"][0]);
  document["rocks"][1]["tree_depth"] = 1;
  const Case scene = test::readJson(document).value();
  const test::TemporaryFolder folder;
  TreeCache cache(folder.path());
  const RockStock stock = stockRocks(scene, cache).value();
  ASSERT_EQ(stock.groups.size(), 2U);
  ASSERT_EQ(stock.groups[0].size(), 2U);
  EXPECT_NE(stock.groups[0][0].tree->info().meshName, stock.groups[0][1].tree->info().meshName);
  EXPECT_NE(stock.groups[0][0].tree->info().meshName, stock.groups[1][0].tree->info().meshName);
  EXPECT_EQ(stockRocks(scene, cache).value().hash, stock.hash);
}

}  // namespace
}  // namespace cairn::rockfall::rocks_test
