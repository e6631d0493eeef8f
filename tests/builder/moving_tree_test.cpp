// SPDX-License-Identifier: GPL-3.0-or-later
// A built tree that followed its moving mesh is proved by `certify`, which knows nothing of how it was refitted.
#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/certify.h"
#include "cairn/core/tree_refit.h"
#include "moving_meshes.h"
#include "surface/mass_properties.h"

namespace cairn::test::moving_tree_test {
namespace {

// The moved mesh as the tree has it, rounded to float; the mass that a moved tree keeps is the first mesh's.
void isProved(const SphereTree& moved) {
  builder::TriangleMesh mesh;
  mesh.triangles.assign(moved.triangles().begin(), moved.triangles().end());
  for (const Vec3& v : moved.vertices()) mesh.vertices.push_back(Vec3d(v) + moved.origin());
  const SphereTree withItsMass =
      tampered(moved, [&](SphereTreeData& data) { data.mass = builder::massPropertiesOf(mesh); });
  const auto certificate = builder::certify(withItsMass, mesh);
  ASSERT_TRUE(certificate);
  EXPECT_EQ(certificate.value().failures(withItsMass), std::vector<std::string>());
}

class MovingTree : public testing::TestWithParam<builder::Method> {};

TEST_P(MovingTree, IsProvedWhereverItIs) {
  for (const MovingMesh& mesh : {bendingBar(3), breathingBall(5), walkingFigure(1)}) {
    SCOPED_TRACE(mesh.name);
    builder::BuildOptions options;
    options.method = GetParam();
    options.depth = 2;
    options.samples = 500;
    auto tree = builder::buildTree(meshOf(mesh.first), options);
    ASSERT_TRUE(tree) << tree.error().message;
    const auto first = std::make_shared<const SphereTree>(std::move(tree).value());
    auto refit = TreeRefit::bind(first);
    ASSERT_TRUE(refit) << refit.error().message;
    for (const double phase : {0.0, 0.6, 1.5, -1.5}) {
      SCOPED_TRACE(phase);
      const auto moved = refit.value().refit(mesh.inTree(*first, phase));
      ASSERT_TRUE(moved) << moved.error().message;
      isProved(*moved.value());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, MovingTree,
                         testing::Values(builder::Method::combined, builder::Method::octree, builder::Method::adaptive),
                         [](const auto& method) { return std::string(builder::methodName(method.param)); });

// Balls that hold their parts by no more than rounding: cutting a triangle may let a ball grow, by this much at most.
TEST(MovedTree, GrowsLittleWhereNothingMoves) {
  constexpr float kMostGrown = 1.5F;
  const auto first = std::make_shared<const SphereTree>(quickTree(meshOf(cuboid({1, 1, 1}, 1)), 3));
  auto refit = TreeRefit::bind(first);
  ASSERT_TRUE(refit) << refit.error().message;
  const auto moved = refit.value().refit(first->vertices());
  ASSERT_TRUE(moved) << moved.error().message;
  double before = 0, after = 0;
  for (std::uint32_t record = 0; record < first->nodeCount(); ++record) {
    const NodeData &was = first->data().nodes[record], &is = moved.value()->data().nodes[record];
    EXPECT_LE(is.radius, kMostGrown * was.radius) << "node " << record;
    before += double(was.radius);
    after += double(is.radius);
  }
  EXPECT_LE(after, 1.05 * before) << "on the mean";
}

double meanLeafError(const SphereTree& tree) {
  double sum = 0;
  for (const NodeId leaf : tree.levelCut(tree.depth())) sum += double(tree.error(leaf));
  return sum / tree.leafCount();
}

// Balls much larger than their regions come out of a ball that became flat.
TEST(MovedTree, MovesCentresAwayFromWhereBallsComeOut) {
  const MovingMesh mesh = breathingBall(8);
  builder::BuildOptions options;
  options.method = builder::Method::combined;
  options.depth = 3;
  auto tree = builder::buildTree(meshOf(mesh.first), options);
  ASSERT_TRUE(tree) << tree.error().message;
  const auto first = std::make_shared<const SphereTree>(std::move(tree).value());
  auto refit = TreeRefit::bind(first);
  ASSERT_TRUE(refit) << refit.error().message;
  double most = 0;
  for (int phase = 0; phase < 8; ++phase) {
    const auto moved = refit.value().refit(mesh.inTree(*first, 0.8 * phase));
    ASSERT_TRUE(moved) << moved.error().message;
    most = std::max(most, meanLeafError(*moved.value()));
  }
  // 1.69 here; 2.11 where centres move with their regions only.
  EXPECT_LE(most, 1.9 * meanLeafError(*first));
}

}  // namespace
}  // namespace cairn::test::moving_tree_test
