// SPDX-License-Identifier: Zlib
// A tree follows a mesh whose vertices move: its balls hold the surface, and its errors hold, at every step.
#include "cairn/core/tree_refit.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "moving_meshes.h"
#include "random_tree.h"
#include "solid_oracle.h"
#include "test_trees.h"

namespace cairn::test::tree_refit_test {
namespace {

constexpr unsigned kSeed = 83;
constexpr int kSteps = 1000;
constexpr double kPhaseOfStep = 0.02;  // radians: 1000 steps are three swings
// Of the oracle's distances, in doubles, to a mesh some units large.
constexpr double kRounding = 1e-12;

std::shared_ptr<const SphereTree> refitted(TreeRefit& refit, std::span<const Vec3> vertices) {
  Result<std::shared_ptr<const SphereTree>> moved = refit.refit(vertices);
  if (!moved) throw std::runtime_error(moved.error().message);
  return std::move(moved).value();
}

TreeRefit bound(const std::shared_ptr<const SphereTree>& tree) {
  Result<TreeRefit> refit = TreeRefit::bind(tree);
  if (!refit) throw std::runtime_error(refit.error().message);
  return std::move(refit).value();
}

// A cube of twelve triangles in eight balls, each of which lists all triangles: they are cut into parts.
std::shared_ptr<const SphereTree> cubeInOctants() {
  const Solid solid = cuboid({2, 2, 2}, 1);
  SphereTreeData data = PlainTreeBuilder(solid, 12).build();
  for (int octant = 0; octant < 8; ++octant) {
    NodeData n = data.nodes[0];
    n.center = {octant & 1 ? 0.5F : -0.5F, octant & 2 ? 0.5F : -0.5F, octant & 4 ? 0.5F : -0.5F};
    n.radius = 0.8661F;  // half the diagonal of a unit cube, and a little
    n.error = 2 * n.radius;
    n.firstSupport = static_cast<std::uint32_t>(data.supportPoints.size());
    n.supportCount = 1;
    data.supportPoints.push_back(n.center * 2.0F);
    data.nodes.push_back(n);
  }
  Result<SphereTree> tree = SphereTree::create(std::move(data));
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

bool holds(const SphereTree& tree, NodeId node, const Vec3d& p) {
  const auto isIn = [&](const Sphere& ball) { return distance(p, Vec3d(ball.center)) <= double(ball.radius); };
  return isIn(tree.sphere(node)) && isIn(tree.bound(node));
}

// Whether a point of a triangle lies in a leaf that lists the triangle, and in all of the leaf's ancestors.
bool isCovered(const SphereTree& tree, std::uint32_t triangle, const Vec3d& p) {
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    const NodeId leaf = tree.nodeAt(record);
    const auto region = tree.regionTriangles(leaf);
    if (!tree.isLeaf(leaf) || !holds(tree, leaf, p) || std::ranges::find(region, triangle) == region.end()) continue;
    std::uint32_t above = record;
    while (above != 0 && holds(tree, tree.nodeAt(tree.data().nodes[above].parent), p))
      above = tree.data().nodes[above].parent;
    if (above == 0) return true;
  }
  return false;
}

Vec3d pointOn(const SolidOracle& solid, std::uint32_t triangle, std::mt19937_64& random) {
  double b = uniform(random), c = uniform(random);
  if (b + c > 1) {
    b = 1 - b;
    c = 1 - c;
  }
  const auto corner = solid.corners(triangle);
  return corner[0] + (corner[1] - corner[0]) * b + (corner[2] - corner[0]) * c;
}

// The invariant of SphereTree on random points of triangles and on all vertices' triangles; then errors and inner
// radii of random nodes on random points of their balls, and their normal cones.
void check(const SphereTree& tree, std::mt19937_64& random) {
  const SolidOracle solid{tree.vertices(), tree.triangles()};
  for (int i = 0; i < 40; ++i) {
    const auto triangle = static_cast<std::uint32_t>(random() % tree.triangles().size());
    ASSERT_TRUE(isCovered(tree, triangle, pointOn(solid, triangle, random))) << "triangle " << triangle;
    ASSERT_TRUE(isCovered(tree, triangle, solid.corners(triangle)[i % 3])) << "corner of triangle " << triangle;
  }
  for (int i = 0; i < 4; ++i) {
    const NodeId node = tree.nodeAt(static_cast<std::uint32_t>(random() % tree.nodeCount()));
    const Sphere ball = tree.sphere(node);
    const NormalCone& cone = tree.node(node).normalCone;
    const auto region = cone.cosine > -1 ? tree.regionTriangles(node) : std::span<const std::uint32_t>();
    for (const std::uint32_t triangle : region) {
      const auto c = solid.corners(triangle);
      const Vec3d normal = normalized(cross(c[1] - c[0], c[2] - c[0]));
      ASSERT_GE(dot(normal, Vec3d(cone.axis)), double(cone.cosine)) << "node " << node;
    }
    const Vec3d outwards = normalized(randomPoint(random));
    const Vec3d inBall = Vec3d(ball.center) + outwards * double(ball.radius);
    ASSERT_LE(solid.toSolid(inBall), double(tree.error(node)) + kRounding) << "node " << node;
    if (tree.innerRadius(node) == 0) continue;
    const Vec3d inSolid = Vec3d(ball.center) + outwards * double(tree.innerRadius(node));
    ASSERT_EQ(solid.toSolid(inSolid), 0) << "node " << node;
  }
}

void followsForAThousandSteps(const MovingMesh& mesh, const std::shared_ptr<const SphereTree>& tree) {
  SCOPED_TRACE(mesh.name + ", seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  TreeRefit refit = bound(tree);
  for (int step = 0; step < kSteps; ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const auto moved = refitted(refit, mesh.inTree(*tree, kPhaseOfStep * step));
    check(*moved, random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(TreeRefit, HoldsABendingBarForAThousandSteps) {
  const MovingMesh mesh = bendingBar(6);
  followsForAThousandSteps(mesh, plainTree(mesh.first, 4));
}

TEST(TreeRefit, HoldsABreathingBallForAThousandSteps) {
  const MovingMesh mesh = breathingBall(6);
  followsForAThousandSteps(mesh, plainTree(mesh.first, 4));
}

TEST(TreeRefit, HoldsAWalkingFigureForAThousandSteps) {
  const MovingMesh mesh = walkingFigure(1);
  followsForAThousandSteps(mesh, plainTree(mesh.first, 4));
}

// Each of its triangles lies in many leaves: parts are what is followed.
TEST(TreeRefit, HoldsTrianglesThatAreCutIntoParts) {
  const auto twist = [](const Vec3d& p, double phase) {
    const double angle = 0.5 * std::sin(phase) * p.z, stretch = 1 + 0.3 * std::sin(1.7 * phase);
    return Vec3d{std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y,
                 stretch * p.z + 0.2 * std::sin(phase) * p.x};
  };
  followsForAThousandSteps({"twisted cube", cuboid({2, 2, 2}, 1), twist}, cubeInOctants());
}

// What the derived numbers say is what a tree of the same data says.
void isAsIfRead(const SphereTree& moved) {
  Result<SphereTree> read = SphereTree::create(moved.data());
  ASSERT_TRUE(read) << read.error().message;
  const SphereTree& fresh = read.value();
  EXPECT_EQ(fresh.data(), moved.data());
  EXPECT_EQ(fresh.extent(), moved.extent());
  const SurfaceFeatures &f = fresh.surface().features, &g = moved.surface().features;
  EXPECT_EQ(f.hasHollows(), g.hasHollows());
  for (std::size_t e = 0; e < f.edges().size(); ++e) {
    EXPECT_EQ(f.edges()[e].outward, g.edges()[e].outward);
    EXPECT_EQ(f.edges()[e].isConvex, g.edges()[e].isConvex);
  }
  for (std::size_t t = 0; t < f.faces().size(); ++t) {
    EXPECT_EQ(f.faces()[t].normal, g.faces()[t].normal);
    EXPECT_EQ(f.faces()[t].inward, g.faces()[t].inward);
  }
  for (std::uint32_t record = 0; record < fresh.nodeCount(); ++record) {
    const NodeId node = fresh.nodeAt(record);
    EXPECT_EQ(fresh.sphere(node), moved.sphere(node));
    EXPECT_EQ(fresh.bound(node), moved.bound(node));
    EXPECT_EQ(fresh.family(node / kFamilyWidth).sphere(node % kFamilyWidth), moved.bound(node));
    EXPECT_EQ(fresh.error(node), moved.error(node));
    EXPECT_EQ(fresh.innerRadius(node), moved.innerRadius(node));
    EXPECT_EQ(fresh.traversalNodes()[node].childLanes, moved.traversalNodes()[node].childLanes);
    EXPECT_EQ(fresh.isFaceted(node), moved.isFaceted(node));
    EXPECT_EQ(fresh.isPlanar(node), moved.isPlanar(node));
    EXPECT_TRUE(std::ranges::equal(fresh.regionCorners(node), moved.regionCorners(node)));
    EXPECT_EQ(fresh.support(node).point(3), moved.support(node).point(3));
  }
}

TEST(TreeRefit, HoldsBothSpheresOfANode) {
  const MovingMesh mesh = bendingBar(6);
  const auto tree = withTwoSpheres(*plainTree(mesh.first, 4), kSeed);
  followsForAThousandSteps(mesh, tree);
  TreeRefit refit = bound(tree);
  const auto moved = refitted(refit, mesh.inTree(*tree, 0.7));
  EXPECT_EQ(moved->spheresPerNode(), 2U);
  isAsIfRead(*moved);
}

TEST(TreeRefit, IsAsATreeReadWithItsNumbers) {
  for (const MovingMesh& mesh : {bendingBar(4), breathingBall(4), walkingFigure(1)}) {
    SCOPED_TRACE(mesh.name);
    const auto tree = plainTree(mesh.first, 4);
    TreeRefit refit = bound(tree);
    for (const double phase : {0.0, 0.7, -1.2}) isAsIfRead(*refitted(refit, mesh.inTree(*tree, phase)));
  }
}

// A patch's own lists and columns, beside those of a surface made anew where vertices did not move.
TEST(TreeRefit, ThatMovedBackHasThePatchesItHad) {
  const MovingMesh mesh = bendingBar(6);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit refit = bound(tree);
  static_cast<void>(refitted(refit, mesh.inTree(*tree, 1)));
  const auto back = refitted(refit, tree->vertices());
  const SurfacePatches &before = tree->surface().patches, &now = back->surface().patches;
  ASSERT_EQ(before.count(), now.count());
  for (std::uint32_t i = 0; i < now.count(); ++i) {
    const SurfacePatch a = before.patch(i), b = now.patch(i);
    EXPECT_TRUE(std::ranges::equal(a.edges, b.edges));
    EXPECT_TRUE(std::ranges::equal(a.edgeEnds, b.edgeEnds));
    EXPECT_EQ(a.convexEdges, b.convexEdges);
    EXPECT_EQ(a.box.lower, b.box.lower);
    EXPECT_EQ(a.normals.upper, b.normals.upper);
    EXPECT_EQ(a.facing, b.facing);
    EXPECT_TRUE(std::equal(a.faceColumns, a.faceColumns + 16 * SurfacePatch::kBatch, b.faceColumns));
    EXPECT_TRUE(std::equal(a.edgeColumns, a.edgeColumns + 9 * SurfacePatch::padded(a.convexEdges), b.edgeColumns));
  }
  for (std::size_t i = 0; i < now.families().size(); ++i)
    for (std::uint32_t lane = 0; lane < PatchFamily::kWidth; ++lane)
      EXPECT_EQ(before.families()[i].box(lane).upper, now.families()[i].box(lane).upper);
  EXPECT_NEAR(back->surface().thickness, tree->surface().thickness, 1e-5);
}

TEST(TreeRefit, HoldsPatchesOfAMovedSurface) {
  const MovingMesh mesh = walkingFigure(1);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit refit = bound(tree);
  const auto moved = refitted(refit, mesh.inTree(*tree, 1.1));
  const SurfacePatches& patches = moved->surface().patches;
  for (std::uint32_t t = 0; t < moved->triangles().size(); ++t)
    for (const std::uint32_t v : moved->triangles()[t]) {
      EXPECT_TRUE(patches.patch(patches.ownersOfTriangles()[t]).box.holds(moved->vertices()[v]));
      EXPECT_TRUE(patches.box().holds(moved->vertices()[v]));
    }
}

// Only the vertices count, not what came before; and again the same bits.
TEST(TreeRefit, GivesTheSameBitsWhateverCameBefore) {
  const MovingMesh mesh = walkingFigure(1);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit one = bound(tree), other = bound(tree);
  for (int step = 0; step < 20; ++step) static_cast<void>(refitted(one, mesh.inTree(*tree, 0.3 * step)));
  const auto a = refitted(one, mesh.inTree(*tree, 2)), b = refitted(other, mesh.inTree(*tree, 2));
  ASSERT_NE(a, b);
  EXPECT_EQ(a->data(), b->data());
  EXPECT_EQ(a->surface().thickness, b->surface().thickness);
}

// A rigid motion costs nothing but rounding.
TEST(TreeRefit, KeepsErrorsOfARigidMotion) {
  const MovingMesh mesh = breathingBall(6);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit refit = bound(tree);
  const auto still = refitted(refit, tree->vertices());
  std::mt19937_64 random(kSeed);
  const Mat3d turn = randomRotation(random);
  std::vector<Vec3> vertices;
  for (const Vec3& v : tree->vertices()) vertices.push_back(Vec3(turn * Vec3d(v) + Vec3d(0.3, -2, 1)));
  const auto moved = refitted(refit, vertices);
  const float rounding = 1e-5F;  // floats of coordinates up to 4
  for (std::uint32_t record = 0; record < tree->nodeCount(); ++record) {
    const NodeId node = tree->nodeAt(record);
    EXPECT_NEAR(moved->sphere(node).radius, still->sphere(node).radius, rounding);
    EXPECT_NEAR(moved->error(node), still->error(node), rounding);
    EXPECT_LE(still->sphere(node).radius, tree->sphere(node).radius + rounding);
    EXPECT_LE(still->error(node), tree->error(node) + rounding) << "the trivial bound of a plain tree is no tighter";
    EXPECT_NEAR(moved->node(node).normalCone.cosine, still->node(node).normalCone.cosine, rounding);
  }
}

// What is not cut sticks out by no more than its longest side, an eighth of the ball's radius.
TEST(TreeRefit, GivesLeavesWhatTheyHold) {
  const auto tree = cubeInOctants();
  TreeRefit refit = bound(tree);
  const auto still = refitted(refit, tree->vertices());
  float most = 0;
  for (std::uint32_t record = 1; record < tree->nodeCount(); ++record)
    most = std::max(most, still->sphere(tree->nodeAt(record)).radius / tree->sphere(tree->nodeAt(record)).radius);
  EXPECT_LE(most, 1.125F);
}

TEST(TreeRefit, LeavesTreesAloneThatSomebodyHolds) {
  const MovingMesh mesh = breathingBall(4);
  const auto tree = plainTree(mesh.first, 4);
  const SphereTreeData before = tree->data();
  TreeRefit refit = bound(tree);
  const auto first = refitted(refit, mesh.inTree(*tree, 1));
  const SphereTreeData then = first->data();
  for (int step = 0; step < 5; ++step) EXPECT_NE(refitted(refit, mesh.inTree(*tree, 0.1 * step)), first);
  EXPECT_EQ(first->data(), then);
  EXPECT_EQ(tree->data(), before);
  const SphereTree* const let = refitted(refit, mesh.inTree(*tree, 1)).get();
  EXPECT_EQ(refitted(refit, mesh.inTree(*tree, 2)).get(), let) << "what nobody holds is used again";
}

void isRefused(TreeRefit& refit, std::span<const Vec3> vertices, const std::string& because) {
  const auto moved = refit.refit(vertices);
  ASSERT_FALSE(moved) << because;
  EXPECT_NE(moved.error().message.find(because), std::string::npos) << moved.error().message;
}

TEST(TreeRefit, RefusesWhatItCannotFollow) {
  const MovingMesh mesh = breathingBall(4);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit refit = bound(tree);
  const std::vector<Vec3> good = mesh.inTree(*tree, 1);
  const auto last = refitted(refit, good);
  const SphereTreeData before = last->data();
  std::vector<Vec3> bad = good;
  bad[7].y = std::numeric_limits<float>::quiet_NaN();
  isRefused(refit, bad, "vertex 7 is not finite");
  bad[7].y = 2e15F;
  isRefused(refit, bad, "vertex 7 is not finite or farther out");
  bad = good;
  bad[tree->triangles()[5][0]] = bad[tree->triangles()[5][1]];
  isRefused(refit, bad, "has lost its area");
  bad = good;
  for (Vec3& v : bad) v.x = -v.x;
  isRefused(refit, bad, "inside out");
  bad = good;
  bad.pop_back();
  isRefused(refit, bad, "it has " + std::to_string(good.size()) + " vertices, not");
  EXPECT_EQ(last->data(), before);
  EXPECT_EQ(refitted(refit, good)->data(), before);
  EXPECT_FALSE(TreeRefit::bind(nullptr));
}

// A mesh that passes through itself is covered all the same.
TEST(TreeRefit, CoversAMeshThatIntersectsItself) {
  const MovingMesh mesh = bendingBar(6);
  const auto tree = plainTree(mesh.first, 4);
  TreeRefit refit = bound(tree);
  std::vector<Vec3> rolled;
  for (const Vec3& v : tree->vertices()) {
    const double angle = double(v.x) * 3.4, arm = 1 - double(v.z);  // more than two turns
    rolled.push_back(Vec3(Vec3d{arm * std::sin(angle), double(v.y), 1 - arm * std::cos(angle)}));
  }
  const auto moved = refit.refit(rolled);
  ASSERT_TRUE(moved) << moved.error().message;
  const SphereTree& now = *moved.value();
  const SolidOracle solid{now.vertices(), now.triangles()};
  std::mt19937_64 random(kSeed);
  for (std::uint32_t triangle = 0; triangle < now.triangles().size(); ++triangle)
    EXPECT_TRUE(isCovered(now, triangle, pointOn(solid, triangle, random)));
}

}  // namespace
}  // namespace cairn::test::tree_refit_test
