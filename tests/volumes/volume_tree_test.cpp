// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/volume_tree.h"

#include <gtest/gtest.h>

#include "cairn/builder/import.h"
#include "distance_oracle.h"
#include "volume_cases.h"

namespace cairn::bench {
namespace {

const std::vector<VolumeKind> kMixed(test::kAllKinds.begin(), test::kAllKinds.end());

TEST(GeneratedSolids, AreSolid) {
  for (const NamedMesh& named : generatedSolids()) {
    const Status solid = builder::checkMesh(named.mesh);
    EXPECT_TRUE(solid) << named.name << ": " << (solid ? "" : solid.error().message);
  }
}

TEST(Cut, KeepsTheSurface) {
  SurfacePart part = builder::piecesOf(test::solidNamed("chair"));
  const double area = test::areaOf(part);
  for (const double at : {2.0, 10.0, 41.0})  // through cells, and where vertices are
    for (int axis = 0; axis < 3; ++axis) {
      const auto halves = cut(part, {axis, at});
      EXPECT_NEAR(test::areaOf(halves[0]) + test::areaOf(halves[1]), area, 1e-9 * area);
      for (const builder::Piece& piece : halves[0])
        for (const Vec3d& corner : piece.corners) EXPECT_LE(corner[axis], at);
      for (const builder::Piece& piece : halves[1])
        for (const Vec3d& corner : piece.corners) EXPECT_GE(corner[axis], at);
    }
}

class VolumeTrees : public testing::TestWithParam<const char*> {
 protected:
  builder::TriangleMesh mesh_ = test::solidNamed(GetParam());
  builder::SignedDistance solid_{mesh_};
  double error_ = 0.03 * solid_.bounds().diagonal();
};
INSTANTIATE_TEST_SUITE_P(Solids, VolumeTrees, testing::Values("rod 1000:1", "I-beam", "chair", "ball"));

TEST_P(VolumeTrees, EveryCutCoversTheSurfaceWithinItsError) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const test::DistanceOracle oracle{mesh_};
  std::mt19937_64 engine(test::kVolumeSeed);
  for (const std::vector<VolumeKind>& kinds : {kMixed, std::vector{VolumeKind::ball}}) {
    const VolumeTree tree = growTree(solid_, kinds, {.error = error_});
    for (const double error : {8 * error_, 2 * error_, error_}) {
      const std::vector<std::uint32_t> cut = cutAt(tree, error);
      for (const builder::Piece& piece : builder::piecesOf(mesh_))
        for (int i = 0; i < 20; ++i) {
          const Vec3d point = test::pointOf(piece, engine);
          EXPECT_TRUE(std::any_of(cut.begin(), cut.end(), [&](std::uint32_t node) {
            return tree.nodes[node].volume.distanceToCore(point) <= tree.nodes[node].volume.radius;
          }));
        }
      for (const std::uint32_t node : cut) {
        EXPECT_LE(tree.nodes[node].error, error);
        for (int i = 0; i < 10; ++i)
          EXPECT_LE(-oracle.depth(test::pointOf(tree.nodes[node].volume, engine)), tree.nodes[node].error);
      }
    }
  }
}

TEST_P(VolumeTrees, ChildrenShareTheirParentsPart) {
  const VolumeTree tree = growTree(solid_, kMixed, {.error = error_});
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const std::uint32_t child = tree.nodes[i].firstChild;
    if (child == 0) continue;
    EXPECT_NEAR(test::areaOf(tree.parts[child]) + test::areaOf(tree.parts[child + 1]), test::areaOf(tree.parts[i]),
                1e-9 * test::areaOf(tree.parts[i]));
  }
}

TEST_P(VolumeTrees, AreTheSameBitsTwice) {
  const VolumeTree once = growTree(solid_, kMixed, {.error = error_}),
                   again = growTree(solid_, kMixed, {.error = error_});
  ASSERT_EQ(once.nodes.size(), again.nodes.size());
  for (std::size_t i = 0; i < once.nodes.size(); ++i) {
    EXPECT_EQ(once.nodes[i].volume.center, again.nodes[i].volume.center);
    EXPECT_EQ(once.nodes[i].volume.radius, again.nodes[i].volume.radius);
    EXPECT_EQ(once.nodes[i].error, again.nodes[i].error);
    EXPECT_EQ(once.nodes[i].firstChild, again.nodes[i].firstChild);
  }
}

std::size_t nodesAt(const char* name, const std::vector<VolumeKind>& kinds, double percent) {
  const builder::TriangleMesh mesh = test::solidNamed(name);
  const builder::SignedDistance solid(mesh);
  const double error = percent / 100 * solid.bounds().diagonal();
  return cutAt(growTree(solid, kinds, {.error = error}), error).size();
}

TEST(MixedVolumes, NeedOneNodeForARodAndThreeForABeam) {
  EXPECT_EQ(nodesAt("rod 1000:1", kMixed, 0.2), 1U);
  EXPECT_EQ(nodesAt("plate 1000:1000:1", kMixed, 0.2), 1U);
  EXPECT_EQ(nodesAt("I-beam", kMixed, 0.6), 3U);
  EXPECT_GT(nodesAt("rod 1000:1", {VolumeKind::ball}, 0.2), 100U);
}

}  // namespace
}  // namespace cairn::bench
