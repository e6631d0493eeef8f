// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"
#include "cairn/core/state_hash.h"
#include "cairn/core/tree_file.h"
#include "hierarchy/region_tree.h"
#include "regions/region_normals.h"
#include "regions/support_points.h"

namespace cairn::builder::hierarchy_test {
namespace {

BuildOptions smallBuild(Method method, std::uint32_t depth = 2) {
  BuildOptions options;
  options.method = method;
  options.depth = depth;
  options.samples = 1000;
  return options;
}

SphereTree built(const TriangleMesh& mesh, const BuildOptions& options) {
  Result<SphereTree> tree = buildTree(mesh, options);
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::move(tree).value();
}

std::string hashOf(const SphereTree& tree) {
  StateHash hash;
  for (const std::byte b : encodeTree(tree)) hash.add(static_cast<std::uint64_t>(b));
  return hash.hex();
}

std::vector<Method> everyMethod() {
  std::vector<Method> methods;
  for (const std::string& name : methodNames()) methods.push_back(parseMethod(name).value());
  return methods;
}

class EveryMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Build, EveryMethod, testing::ValuesIn(everyMethod()), [](const auto& name) {
  std::string text = methodName(name.param);
  std::erase(text, '-');
  return text;
});

TEST_P(EveryMethod, SymmetricAndRoundSolids_AreProvedToBeCovered) {
  const std::vector<TriangleMesh> meshes{test::meshOf(test::cuboid({1, 1, 1}, 1)),
                                         test::meshOf(test::ball(1, 1)),
                                         test::meshOf(test::ball(1, 2)),
                                         test::torus(1, 0.35, 16, 8),
                                         test::lumpyBall(2, 1),
                                         test::meshOf(test::cuboid({2, 0.5, 0.5}, 1)),
                                         test::cylinder(0.3, 2, 12)};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SCOPED_TRACE("mesh " + std::to_string(i));
    // The last two are there for sets that fail on long symmetric shapes; one level shows it.
    const std::uint32_t depth = i < 5 ? 2 : 1;
    const SphereTree tree = built(meshes[i], smallBuild(GetParam(), depth));
    EXPECT_GT(tree.leafCount(), depth == 2 ? 8U : 2U);
    const Result<Certificate> certificate = certify(tree, meshes[i]);
    ASSERT_TRUE(certificate);
    EXPECT_EQ(certificate.value().failures(tree), std::vector<std::string>{});
  }
}

TEST_P(EveryMethod, AnyNumberOfThreads_GivesTheSameBits) {
  const TriangleMesh mesh = test::lumpyBall(2, 8);
  BuildOptions options = smallBuild(GetParam());
  options.threads = 1;
  const std::string first = hashOf(built(mesh, options));
  options.threads = 2;
  EXPECT_EQ(hashOf(built(mesh, options)), first);
}

TEST_P(EveryMethod, DeeperLevels_HaveSmallerErrors) {
  const SphereTree tree = built(test::torus(1, 0.35, 16, 8), smallBuild(GetParam()));
  // The root is a smallest ball whatever the method; the balls around an octree's first cubes may stand off more.
  if (!dividesByEight(GetParam())) EXPECT_LT(tree.levelError(1), tree.levelError(0));
  EXPECT_LT(tree.levelError(2), tree.levelError(1));
}

constexpr SurfaceDivision kOwn = SurfaceDivision::standOff;

struct SetTreatment {
  const char* name;
  Method method;
  std::optional<Optimiser> optimiser;
  std::optional<Balance> balance;
  SurfaceDivision division;
  const char* goldenHash;  ///< of a small cuboid's tree; see SmallTree_HasItsGoldenHash
  bool twoSpheres = false;
};

class EveryTreatment : public testing::TestWithParam<SetTreatment> {
 protected:
  static BuildOptions options() {
    BuildOptions o = smallBuild(GetParam().method);
    o.optimiser = GetParam().optimiser;
    o.balance = GetParam().balance;
    o.division = GetParam().division;
    o.twoSpheres = GetParam().twoSpheres;
    return o;
  }
};
INSTANTIATE_TEST_SUITE_P(
    Build, EveryTreatment,
    testing::Values(
        SetTreatment{"balanced", Method::combined, {}, constantExcess(0.05), kOwn, "3a56e155733d2c0d"},
        SetTreatment{"balancedByWork", Method::merge, {}, kBalanceByWork, kOwn, "aff666e4a7b1afb9"},
        SetTreatment{"thesis", Method::combined, Optimiser::thesis, {}, kOwn, "bd87f35786ccf048"},
        SetTreatment{"thesisBalanced", Method::expandCover, Optimiser::thesis, constantExcess(0.05), kOwn,
                     "83536354dc5416d5"},
        SetTreatment{
            "thesisPlanes", Method::expand, Optimiser::thesis, {}, SurfaceDivision::planes, "df236733d83c917d"},
        SetTreatment{"unoptimised", Method::combined, Optimiser::none, {}, kOwn, "5ba1073db3cf0d90"},
        SetTreatment{"gridPlanes", Method::grid, {}, {}, SurfaceDivision::planes, "54e7f1d6a37e495f"},
        SetTreatment{"hybrid", Method::hybrid, {}, {}, kOwn, "44aabb652bc53938"},
        SetTreatment{"hybridTwoSpheres", Method::hybrid, {}, {}, kOwn, "8785261117476870", true},
        SetTreatment{"spawnByCairn", Method::spawn, Optimiser::cairn, {}, kOwn, "04a0e03380b8554f"}),
    [](const auto& treatment) { return std::string(treatment.param.name); });

TEST_P(EveryTreatment, AnySolid_IsProvedToBeCoveredWithTheSameBitsForAnyNumberOfThreads) {
  for (const TriangleMesh& mesh : {test::lumpyBall(2, 8), test::meshOf(test::cuboid({1, 1, 1}, 1))}) {
    BuildOptions o = options();
    o.threads = 1;
    const SphereTree tree = built(mesh, o);
    const Result<Certificate> certificate = certify(tree, mesh);
    ASSERT_TRUE(certificate);
    EXPECT_EQ(certificate.value().failures(tree), std::vector<std::string>{});
    o.threads = 2;
    EXPECT_EQ(hashOf(built(mesh, o)), hashOf(tree));
  }
}

TEST_P(EveryTreatment, SmallTree_HasItsGoldenHash) {
  EXPECT_EQ(hashOf(built(test::meshOf(test::cuboid({1, 0.7, 0.4}, 2)), options())), GetParam().goldenHash);
}

TEST(Build, Treatment_IsNamedInTheTree) {
  BuildOptions options = smallBuild(Method::merge, 1);
  options.optimiser = Optimiser::thesis;
  options.balance = constantExcess(0.05);
  options.division = SurfaceDivision::planes;
  options.twoSpheres = true;
  EXPECT_EQ(built(test::meshOf(test::cuboid({1, 1, 1}, 1)), options).info().method,
            "merge+optimise-thesis+balance-0.05+divide-planes+two-spheres");
}

TEST(Build, Combined_BeatsTheOctreeByFar) {
  const TriangleMesh mesh = test::torus(1, 0.35, 24, 12);
  const SphereTree combined = built(mesh, smallBuild(Method::combined)),
                   octree = built(mesh, smallBuild(Method::octree));
  for (std::uint32_t level = 1; level <= 2; ++level)
    EXPECT_LT(combined.levelError(level), 0.5F * octree.levelError(level));
}

TEST(Build, Branching_BoundsEveryFamily) {
  BuildOptions options = smallBuild(Method::combined);
  options.branching = 3;
  const SphereTree tree = built(test::lumpyBall(2, 3), options);
  std::vector<std::uint32_t> children(tree.nodeCount(), 0);
  for (std::size_t i = 1; i < tree.data().nodes.size(); ++i) ++children[tree.data().nodes[i].parent];
  EXPECT_LE(*std::max_element(children.begin(), children.end()), 3U);
  EXPECT_EQ(tree.depth(), 2U);
}

// Regenerate after a deliberate change: builder_tests --gtest_filter=*SmallTree_HasItsGoldenHash* prints the new ones.
TEST(Build, SmallTree_HasItsGoldenHash) {
  const SphereTree tree = built(test::meshOf(test::cuboid({1, 0.7, 0.4}, 2)), smallBuild(Method::combined));
  EXPECT_EQ(hashOf(tree), "fcf71d01529a8489");
}

TEST(Build, OptionsOutOfRange_AreNamedInOneSentence) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 1));
  const auto refusal = [&](auto change) {
    BuildOptions options;
    change(options);
    const Result<SphereTree> tree = buildTree(mesh, options);
    return tree ? std::string() : tree.error().message;
  };
  EXPECT_EQ(refusal([](BuildOptions& o) { o.branching = 9; }), "the option branching is 9; choose 2 to 8");
  EXPECT_EQ(refusal([](BuildOptions& o) { o.branching = 1; }), "the option branching is 1; choose 2 to 8");
  EXPECT_EQ(refusal([](BuildOptions& o) { o.depth = 0; }), "the option depth is 0; choose 1 to 8");
  EXPECT_EQ(refusal([](BuildOptions& o) { o.samples = 99; }), "the option samples is 99; choose 100 to 1000000");
  EXPECT_EQ(refusal([](BuildOptions& o) { o.threads = 2000; }), "the option threads is 2000; choose 0 to 1024");
  EXPECT_NE(refusal([](BuildOptions& o) {
              o.method = Method::octree;
              o.branching = 4;
            }).find("choose 8"),
            std::string::npos);
  EXPECT_NE(refusal([](BuildOptions& o) {
              o.method = Method::adaptive;
              o.balance = constantExcess(0.05);
            }).find("region by region, as the option balance needs"),
            std::string::npos);
  EXPECT_NE(refusal([](BuildOptions& o) {
              o.method = Method::hubbard;
              o.optimiser = Optimiser::thesis;
            }).find("region by region, as the option optimiser needs"),
            std::string::npos);
  EXPECT_NE(refusal([](BuildOptions& o) {
              o.method = Method::octree;
              o.division = SurfaceDivision::planes;
            }).find("choose another method"),
            std::string::npos);
  EXPECT_NE(refusal([](BuildOptions& o) { o.division = SurfaceDivision::planes; }).find("choose the optimiser none"),
            std::string::npos);
}

TEST(Build, OpenMesh_IsRefused) {
  TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 1));
  mesh.triangles.pop_back();
  EXPECT_FALSE(buildTree(mesh, {}));
}

BuildOptions balancedBuild() {
  BuildOptions options = smallBuild(Method::combined);
  options.balance = constantExcess(0.05);
  return options;
}

TEST(Build, Progress_NeverFallsAndEndsAtOne) {
  double last = 0;
  bool falls = false;
  const Result<SphereTree> tree =
      buildTree(test::lumpyBall(1, 1), balancedBuild(), [&](std::string_view, double fraction) {
        falls = falls || fraction < last;
        last = fraction;
        return true;
      });
  ASSERT_TRUE(tree);
  EXPECT_FALSE(falls);
  EXPECT_EQ(last, 1);
}

TEST(Build, CancelledAtAnyReport_SaysSo) {
  const TriangleMesh mesh = test::lumpyBall(1, 1);
  const BuildOptions options = balancedBuild();
  int reports = 0;
  ASSERT_TRUE(buildTree(mesh, options, [&](std::string_view, double) { return ++reports > 0; }));
  for (int stop = 1; stop <= reports; ++stop) {
    int seen = 0;
    const Result<SphereTree> tree = buildTree(mesh, options, [&](std::string_view, double) { return ++seen < stop; });
    ASSERT_FALSE(tree) << "stopped at report " << stop;
    EXPECT_EQ(tree.error().message, kCancelled);
  }
}

// Levels of many spheres take minutes; they are to end soon when told to.
TEST(Build, AdaptiveAsksWithinItsLevels) {
  const TriangleMesh mesh = test::lumpyBall(1, 1);
  BuildOptions options;
  options.method = Method::adaptive;
  options.depth = 2;
  options.branching = 3;
  int reports = 0;
  ASSERT_TRUE(buildTree(mesh, options, [&](std::string_view, double) { return ++reports > 0; }));
  EXPECT_GT(reports, 100) << "once a sweep, not once a level";
  for (const int stop : {10, reports / 2}) {
    int seen = 0;
    const Result<SphereTree> tree = buildTree(mesh, options, [&](std::string_view, double) { return ++seen < stop; });
    ASSERT_FALSE(tree) << "stopped at report " << stop;
    EXPECT_EQ(tree.error().message, kCancelled);
    EXPECT_EQ(seen, stop) << "not asked again";
  }
}

TEST(Method, NamesRoundTrip) {
  for (const Method method : everyMethod()) {
    const Result<Method> parsed = parseMethod(methodName(method));
    ASSERT_TRUE(parsed);
    EXPECT_EQ(parsed.value(), method);
  }
  EXPECT_FALSE(parseMethod("spline"));
  for (const std::string& name : optimiserNames()) EXPECT_EQ(optimiserName(parseOptimiser(name).value()), name);
  EXPECT_FALSE(parseOptimiser("spline"));
}

TEST(RegionTree, ChildrenRegions_CoverTheParentsAndStayInAllAncestors) {
  const TriangleMesh mesh = test::lumpyBall(2, 12);
  const SignedDistance solid(mesh);
  const SplitSettings settings{Method::combined, 8, 1, 1e-6};
  const RegionTree tree = growRegionTree(rootRegion(solid, 800), 2, solid, settings, [](auto...) { return true; });
  for (const RegionNode& node : tree) {
    std::vector<double> left(mesh.triangles.size(), 0);
    for (const Piece& piece : node.region.pieces) left[piece.source] += areaOf(piece);
    for (std::uint32_t c = 0; c < node.childCount; ++c)
      for (const Piece& piece : tree[node.firstChild + c].region.pieces) left[piece.source] -= areaOf(piece);
    if (node.childCount > 0) {
      for (const double area : left) EXPECT_NEAR(area, 0, 1e-12);
    }
    // Midpoints of a region's pieces are rounded, its ancestors' balls were measured without them.
    for (const RegionNode* above = &node;; above = &tree[above->parent]) {
      for (const Piece& piece : node.region.pieces)
        for (const Vec3d& corner : piece.corners)
          ASSERT_LE(distance(corner, above->region.ball.center), above->region.ball.radius + 1e-14);
      if (above == &tree[0]) break;
    }
  }
}

TEST(NodeData, Normals_LieInTheirCones) {
  const TriangleMesh mesh = test::lumpyBall(2, 5);
  const SphereTree tree = built(mesh, smallBuild(Method::combined));
  for (const NodeData& node : tree.data().nodes) {
    for (std::uint32_t k = 0; k < node.triangleCount; ++k) {
      const auto [a, b, c] = mesh.corners(tree.data().regionTriangles[node.firstTriangle + k]);
      const Vec3d normal = normalized(cross(b - a, c - a));
      EXPECT_GE(dot(normal, Vec3d(node.normalCone.axis)), node.normalCone.cosine);
    }
  }
}

TEST(NodeData, BallsOfTheFloatMesh_HoldItsVertices) {
  const TriangleMesh mesh = test::lumpyBall(2, 6);
  const SphereTree tree = built(mesh, smallBuild(Method::combined));
  const NodeData& root = tree.data().nodes[0];
  for (const Vec3& v : tree.vertices())
    EXPECT_LE(distance(Vec3d(v), Vec3d(root.center)), static_cast<double>(root.radius));
}

TEST(DominantNormals, Cuboid_HasThreeExactOnes) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({3, 2, 1}, 1));
  // Without the opposite faces: the three largest are left.
  Pieces pieces = piecesOf(mesh);
  std::erase_if(pieces, [&](const Piece& p) {
    const Vec3d n = cross(p.corners[1] - p.corners[0], p.corners[2] - p.corners[0]);
    return n.x + n.y + n.z < 0;
  });
  const std::vector<Vec3> normals = dominantNormals(facingAreas(pieces, mesh));
  EXPECT_EQ(normals, (std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
}

TEST(NormalCone, WholeSolid_FacesEverywhere) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 1));
  EXPECT_EQ(normalConeOf(facingAreas(piecesOf(mesh), mesh)).cosine, -1);
}

TEST(SupportPoints, Choice_ReachesNearlyAsFarAsAllPoints) {
  const TriangleMesh mesh = test::lumpyBall(2, 21);
  Pieces pieces = piecesOf(mesh);
  std::erase_if(pieces, [](const Piece& p) { return centroidOf(p).z < 0.5; });
  const std::vector<Vec3d> points = cornersOf(pieces);
  const std::vector<FacingArea> areas = facingAreas(pieces, mesh);
  const std::vector<Vec3d> chosen = chooseSupportPoints(points, areas, kMaxSupportPoints, 1e-9);
  EXPECT_LE(chosen.size(), kMaxSupportPoints);
  const auto reach = [](const std::vector<Vec3d>& list, const Vec3d& direction) {
    double best = -1e300;
    for (const Vec3d& p : list) best = std::max(best, dot(p, direction));
    return best;
  };
  // Sixteen points for a bumpy cap about 1.6 wide: they may miss a bump, not a side. Bumps are 0.3 high.
  for (const FacingArea& a : areas) EXPECT_GE(reach(chosen, a.normal), reach(points, a.normal) - 0.1);
}

}  // namespace
}  // namespace cairn::builder::hierarchy_test
