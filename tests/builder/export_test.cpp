// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/import.h"
#include "run_program.h"
#include "surface/icosphere.h"
#include "surface/mass_properties.h"

namespace cairn::builder::export_test {
namespace {

struct Line {
  std::uint32_t level = 0;
  Vec3d center;
  double radius = 0;
  std::int64_t parent = 0;
};

std::vector<Line> readSpheres(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (Line l; in >> l.level >> l.center.x >> l.center.y >> l.center.z >> l.radius >> l.parent;) lines.push_back(l);
  EXPECT_TRUE(in.eof());
  return lines;
}

Vec3d meshCenter(const SphereTree& tree, std::uint32_t record) {
  return tree.origin() + Vec3d(tree.data().nodes[record].center);
}

TEST(ExportSpheres, RoundTripsEveryBit) {
  const TriangleMesh mesh = test::moved(test::lumpyBall(5, 1), [](const Vec3d& v) { return v + Vec3d{100, 0.1, -7}; });
  const SphereTree tree = test::quickTree(mesh);
  const std::vector<Line> lines = readSpheres(spheresText(tree));
  ASSERT_EQ(lines.size(), tree.nodeCount());
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].center, meshCenter(tree, i));
    EXPECT_EQ(lines[i].radius, tree.data().nodes[i].radius);
    EXPECT_EQ(lines[i].level, tree.level(tree.nodeAt(i)));
    EXPECT_EQ(lines[i].parent, i == 0 ? -1 : static_cast<std::int64_t>(tree.data().nodes[i].parent));
    if (i > 0) EXPECT_LE(lines[i - 1].level, lines[i].level);  // breadth-first
  }
}

TEST(ExportSph, RoundTripsThroughAReaderOfTheFormat) {
  const TriangleMesh mesh = test::torus(1, 0.3, 16, 8);
  const SphereTree tree = test::quickTree(mesh);
  const Result<std::string> text = sphText(tree);
  ASSERT_TRUE(text.ok());
  std::istringstream in(text.value());
  std::size_t levels = 0, degree = 0;
  in >> levels >> degree;
  ASSERT_EQ(levels, tree.depth() + 1);
  ASSERT_LE(degree, 8U);
  std::size_t slots = 0;
  for (std::size_t level = 0, width = 1; level < levels; ++level, width *= degree) slots += width;
  struct Slot {
    Vec3d center;
    double radius, importance;
  };
  std::vector<Slot> read;
  for (Slot s; in >> s.center.x >> s.center.y >> s.center.z >> s.radius >> s.importance;) read.push_back(s);
  ASSERT_EQ(read.size(), slots);

  // Walk both trees side by side from the root.
  std::size_t used = 0;
  const auto walk = [&](const auto& self, std::size_t slot, NodeId node) -> void {
    ++used;
    const Sphere sphere = tree.sphere(node);
    EXPECT_EQ(read[slot].center, tree.origin() + Vec3d(sphere.center));
    EXPECT_EQ(read[slot].radius, sphere.radius);
    const std::uint32_t family = tree.childFamily(node);
    for (std::size_t c = 0; c < degree && slot * degree + 1 + c < slots; ++c) {
      const std::size_t child = slot * degree + 1 + c;
      if (c < tree.childCount(node))
        self(self, child, family * kFamilyWidth + static_cast<std::uint32_t>(c));
      else
        EXPECT_LT(read[child].radius, 0);
    }
  };
  walk(walk, 0, kRootNode);
  EXPECT_EQ(used, tree.nodeCount());
}

TEST(Icosphere, IsAClosedSphere) {
  for (int subdivisions = 0; subdivisions < 4; ++subdivisions) {
    const TriangleMesh mesh = unitIcosphere(subdivisions);
    EXPECT_TRUE(checkMesh(mesh).ok());
    EXPECT_EQ(mesh.triangles.size(), 20U << (2 * subdivisions));
    for (const Vec3d& v : mesh.vertices) EXPECT_NEAR(length(v), 1, 1e-15);
  }
}

TEST(ExportSurfaces, OfTheRootIsASphereInTheMeshFrame) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = test::moved(test::lumpyBall(4, 1), [](const Vec3d& v) { return v + Vec3d{3, 2, 1}; });
  const SphereTree tree = test::quickTree(mesh);
  for (const auto& [format, name] :
       {std::pair(SurfaceFormat::obj, "root.obj"), std::pair(SurfaceFormat::glb, "root.glb")}) {
    const Status written = writeSphereSurfaces(tree, 0, format, folder.path() / name);
    ASSERT_TRUE(written.ok()) << written.error().message;
    const Result<TriangleMesh> read = importMesh(folder.path() / name);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read.value().triangles.size(), 320U);
    for (const Vec3d& v : read.value().vertices)
      EXPECT_NEAR(distance(v, meshCenter(tree, 0)), tree.data().nodes[0].radius, 1e-6);  // float coordinates near 3
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++files;
  EXPECT_EQ(files, 2U);  // no material file, no temporary one
}

TEST(ExportSurfaces, HoldOneSpherePerNodeOfTheLevel) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = test::lumpyBall(4, 1);
  const SphereTree tree = test::quickTree(mesh);
  ASSERT_TRUE(writeSphereSurfaces(tree, 1, SurfaceFormat::obj, folder.path() / "a.obj").ok());
  std::istringstream in(test::contentOf(folder.path() / "a.obj"));
  std::size_t faces = 0;
  for (std::string line; std::getline(in, line);) faces += line.rfind("f ", 0) == 0;
  EXPECT_EQ(faces, 320 * tree.levelCut(1).size());
}

TEST(ExportSurfaces, RefuseALevelTheTreeLacksAndAFolderThatIsMissing) {
  const TriangleMesh mesh = test::lumpyBall(4, 1);
  const SphereTree tree = test::quickTree(mesh);
  const test::TemporaryFolder folder;
  const Status level = writeSphereSurfaces(tree, 9, SurfaceFormat::obj, folder.path() / "a.obj");
  ASSERT_FALSE(level.ok());
  EXPECT_NE(level.error().message.find("levels 0 to 2, not 9"), std::string::npos);
  EXPECT_FALSE(writeSphereSurfaces(tree, 1, SurfaceFormat::obj, folder.path() / "no" / "a.obj").ok());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cairn::builder::export_test
