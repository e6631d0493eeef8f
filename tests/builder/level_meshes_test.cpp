// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/level_meshes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/import.h"
#include "cairn/builder/simplify.h"

namespace cairn::builder::level_meshes_test {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

/// CGAL's own measure of the distance shares no code with ours.
Surface surfaceOf(const TriangleMesh& mesh) {
  Surface surface;
  std::vector<Surface::Vertex_index> names;
  for (const Vec3d& v : mesh.vertices) names.push_back(surface.add_vertex(Point(v.x, v.y, v.z)));
  for (const Triangle& t : mesh.triangles) surface.add_face(names[t[0]], names[t[1]], names[t[2]]);
  return surface;
}

double hausdorff(const TriangleMesh& a, const TriangleMesh& b, double bound) {
  return CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
      surfaceOf(a), surfaceOf(b), bound);
}

/// A ball with a horn: what a quadric error gives up first.
TriangleMesh hornedBall() {
  TriangleMesh mesh = test::lumpyBall(12, 3);
  const auto tip = std::ranges::max_element(mesh.vertices, {}, &Vec3d::z);
  tip->z += 1;
  return mesh;
}

std::vector<LevelMesh> levelsOf(const TriangleMesh& mesh, const Vec3d& origin = {}) {
  constexpr std::array<std::uint32_t, 2> kSpheres{8, 40};
  return makeLevelMeshes(mesh, origin, kSpheres).value();
}

TriangleMesh placed(const LevelMesh& level, const Vec3d& origin) {
  TriangleMesh mesh;
  for (const Vec3& v : level.vertices) mesh.vertices.push_back(origin + Vec3d(v));
  mesh.triangles.assign(level.triangles.begin(), level.triangles.end());
  return mesh;
}

TEST(LevelMeshes, AreClosedAndAsNearAsTheySay) {
  for (const TriangleMesh& mesh :
       {test::lumpyBall(12, 1), hornedBall(), test::torus(1, 0.3, 40, 20), test::cylinder(0.4, 2, 200)}) {
    const double diagonal = boundsOf(mesh).diagonal();
    const std::vector<LevelMesh> levels = levelsOf(mesh);
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_LE(levels[0].triangles.size(), 48U);
    EXPECT_LE(levels[1].triangles.size(), 240U);
    EXPECT_LT(levels[1].distance, levels[0].distance);
    for (const LevelMesh& level : levels) {
      const TriangleMesh coarse = placed(level, {});
      EXPECT_TRUE(checkMesh(coarse).ok());
      const double bound = 1e-3 * diagonal, found = hausdorff(coarse, mesh, bound);
      EXPECT_GE(double(level.distance), found - bound);
      EXPECT_LE(double(level.distance), 1.02 * (found + bound)) << "enclosed to one per cent";
    }
  }
}

TEST(LevelMeshes, KeepThinParts) {
  const TriangleMesh mesh = hornedBall();
  const TriangleMesh byQuadrics = simplify(mesh, 48).value();
  const double bound = 1e-3 * boundsOf(mesh).diagonal();
  EXPECT_LT(double(levelsOf(mesh)[0].distance), 0.7 * hausdorff(byQuadrics, mesh, bound));
}

TEST(LevelMeshes, FarFromTheOrigin_AreAsNear) {
  const Vec3d origin(1e6, -2e6, 3e5);
  TriangleMesh mesh = test::lumpyBall(12, 1);
  for (Vec3d& v : mesh.vertices) v += origin;
  for (const LevelMesh& level : levelsOf(mesh, origin)) {
    const double bound = 1e-3 * boundsOf(mesh).diagonal();
    EXPECT_GE(double(level.distance), hausdorff(placed(level, origin), mesh, bound) - bound);
  }
}

TEST(LevelMeshes, OfACoarseMesh_AreNone) {
  EXPECT_TRUE(levelsOf(test::meshOf(test::cuboid({1, 1, 1}, 1))).empty());
}

TEST(LevelMeshes, TwoPinchedSolids_AreOneSentence) {
  TriangleMesh mesh = test::lumpyBall(8, 1);
  const Vec3d top = *std::ranges::max_element(mesh.vertices, {}, &Vec3d::z);
  TriangleMesh upside = mesh;
  for (Vec3d& v : upside.vertices) v = {2 * top.x - v.x, v.y, 2 * top.z - v.z};
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto topIndex = static_cast<std::uint32_t>(std::ranges::find(mesh.vertices, top) - mesh.vertices.begin());
  TriangleMesh pinched = test::joined(mesh, upside);
  for (Triangle& t : pinched.triangles)
    for (std::uint32_t& v : t)
      if (v == count + topIndex) v = topIndex;
  const std::array<std::uint32_t, 1> spheres{8};
  const auto levels = makeLevelMeshes(pinched, {}, spheres);
  ASSERT_FALSE(levels.ok());
  EXPECT_NE(levels.error().message.find("only touch"), std::string::npos) << levels.error().message;
}

TEST(LevelMeshes, EndSoonAfterACancellation) {
  const std::array<std::uint32_t, 1> spheres{8};
  int calls = 0;
  const auto levels =
      makeLevelMeshes(test::lumpyBall(12, 1), {}, spheres, [&](std::string_view, double) { return ++calls < 5; });
  ASSERT_FALSE(levels.ok());
  EXPECT_EQ(levels.error().message, kCancelled);
  EXPECT_EQ(calls, 5);
}

TEST(LevelMeshes, SameBitsTwice) {
  EXPECT_EQ(levelsOf(hornedBall()), levelsOf(hornedBall()));
}

SphereTree treeWithMeshes(const TriangleMesh& mesh) {
  BuildOptions options;
  options.method = Method::octree;
  options.depth = 2;
  options.samples = 500;
  options.levelMeshes = true;
  return buildTree(mesh, options).value();
}

TEST(LevelMeshes, AreBuiltWhenAskedFor_AndCertified) {
  const TriangleMesh mesh = test::lumpyBall(12, 1);
  EXPECT_EQ(test::quickTree(mesh).levelMeshCount(), 0U) << "nobody asked";
  const SphereTree tree = treeWithMeshes(mesh);
  ASSERT_GT(tree.levelMeshCount(), 0U);
  EXPECT_TRUE(certify(tree, mesh).value().failures(tree).empty());
  EXPECT_EQ(sourceMeshOf(tree).triangles.size(), mesh.triangles.size());
}

TEST(LevelMeshes, ThatClaimTooMuch_AreRefuted) {
  const TriangleMesh mesh = test::lumpyBall(12, 1);
  const SphereTree tree = treeWithMeshes(mesh);
  const auto refuted = [&](const auto& change) {
    const SphereTree changed = test::tampered(tree, change);
    const auto failures = certify(changed, mesh).value().failures(changed);
    return failures.empty() ? std::string() : failures.front();
  };
  EXPECT_NE(refuted([](auto& d) { d.levelMeshes[0].distance *= 0.9F; }).find("level mesh 1"), std::string::npos);
  EXPECT_NE(refuted([](auto& d) { d.levelMeshes[0].vertices[3] *= 1.5F; }).find("level mesh 1"), std::string::npos);
  EXPECT_NE(refuted([](auto& d) { d.levelMeshes[0].triangles.pop_back(); }).find("level mesh 1"), std::string::npos);
  EXPECT_NE(refuted([](auto& d) {
              for (auto& t : d.levelMeshes[0].triangles) std::swap(t[0], t[1]);
            }).find("level mesh 1"),
            std::string::npos);
}

}  // namespace
}  // namespace cairn::builder::level_meshes_test
