// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/pair_traversal.h"

#include <gtest/gtest.h>

#include <set>

#include "distance_oracle.h"
#include "volume_cases.h"
#include "volumes/measure.h"
#include "volumes/touching_poses.h"
#include "volumes/volume_tree.h"

namespace cairn::bench {
namespace {

/// Whether the open segment passes through the triangle, away from its border.
bool passes(const Vec3d& from, const Vec3d& to, const builder::Piece& triangle) {
  const auto& [a, b, c] = triangle.corners;
  const auto volume = [](const Vec3d& p, const Vec3d& q, const Vec3d& r, const Vec3d& s) {
    return dot(cross(q - p, r - p), s - p);
  };
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0) return false;
  const double u = volume(from, to, a, b), v = volume(from, to, b, c), w = volume(from, to, c, a);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

bool areCrossing(const SurfacePart& a, const SurfacePart& b) {
  for (const builder::Piece& p : a)
    for (const builder::Piece& q : b)
      for (std::size_t i = 0; i < 3; ++i)
        if (passes(p.corners[i], p.corners[(i + 1) % 3], q) || passes(q.corners[i], q.corners[(i + 1) % 3], p))
          return true;
  return false;
}

SurfacePart movedPart(SurfacePart part, const RigidMove& move) {
  for (builder::Piece& piece : part)
    for (Vec3d& corner : piece.corners) corner = move * corner;
  return part;
}

TraversedTree<SweptBall> traversed(const VolumeTree& tree) {
  TraversedTree<SweptBall> nodes;
  for (const VolumeNode& n : tree.nodes) nodes.push_back({n.volume, n.error, n.firstChild});
  return nodes;
}

class Traversals : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solids, Traversals, testing::Values("rod 1000:1", "I-beam", "chair", "ball"));

TEST_P(Traversals, FindEveryPairOfPartsThatCross) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const builder::TriangleMesh mesh = test::solidNamed(GetParam());
  const builder::SignedDistance solid(mesh);
  const double size = solid.bounds().diagonal(), error = 0.05 * size;
  std::size_t crossing = 0;
  for (const auto& kinds :
       {std::vector{VolumeKind::ball}, std::vector(test::kAllKinds.begin(), test::kAllKinds.end())}) {
    const VolumeTree tree = growTree(solid, kinds, {.error = error});
    const std::vector<std::uint32_t> cut = cutAt(tree, error);
    PairTraversal<SweptBall> traversal;
    std::mt19937_64 engine(test::kVolumeSeed);
    for (int pose = 0; pose < 6; ++pose) {
      // A point of one surface on a point of the other: turned at random, the surfaces cross there.
      RigidMove move{test::randomRotation(engine), {}};
      const builder::Pieces pieces = builder::piecesOf(mesh);
      const auto anyPoint = [&] { return test::pointOf(pieces[engine() % pieces.size()], engine); };
      const Vec3d from = anyPoint();
      move.translation = anyPoint() - move.rotation * from;
      const double lengths = 2 * size + 2 * length(solid.bounds().center()) + length(move.translation);
      const double rootErrors = 2 * tree.nodes[0].error;
      EXPECT_EQ(traversal.run(traversed(tree), traversed(tree), move, inverseOf(move), error, lengths, 1).worstError,
                rootErrors);
      const double left =
          traversal.run(traversed(tree), traversed(tree), move, inverseOf(move), error, lengths).worstError;
      EXPECT_LE(left, 2 * error);
      (void)traversal.run(traversed(tree), traversed(tree), move, inverseOf(move), error, lengths);
      const std::set<std::pair<std::uint32_t, std::uint32_t>> found(traversal.found().begin(), traversal.found().end());
      for (const std::uint32_t b : cut) {
        const SurfacePart moved = movedPart(tree.parts[b], move);
        for (const std::uint32_t a : cut) {
          if (!areCrossing(tree.parts[a], moved)) continue;
          ++crossing;
          EXPECT_TRUE(found.contains({a, b}));
        }
      }
    }
  }
  EXPECT_GT(crossing, 5U);
}

TEST_P(Traversals, PosesTouch) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const builder::TriangleMesh mesh = test::solidNamed(GetParam());
  const builder::SignedDistance solid(mesh);
  const test::DistanceOracle oracle{mesh};
  const double size = solid.bounds().diagonal(), tolerance = 1e-3 * size;
  std::mt19937_64 engine(test::kVolumeSeed);
  for (const RigidMove& move : touchingPoses(solid, 8, test::kVolumeSeed, tolerance)) {
    const Gap gap = surfaceGap(solid, mesh, move, tolerance / 8);
    EXPECT_LT(gap.upper, 0);
    EXPECT_GE(gap.lower, -tolerance);
    for (const builder::Piece& piece : movedPart(builder::piecesOf(mesh), move))
      for (int i = 0; i < 4; ++i) EXPECT_GE(-oracle.depth(test::pointOf(piece, engine)), gap.lower);
  }
}

TEST(KeepingMixedVolumes, PaysOnABeamAndNotOnARock) {
  MeasureOptions options;
  options.poses = 1;
  options.runs = 1;
  options.runMs = 0;
  options.errorPercents = {2};
  const std::vector<KindSet> sets{{"spheres", {VolumeKind::ball}},
                                  {"mixed", {test::kAllKinds.begin(), test::kAllKinds.end()}}};
  const auto keeps = [&](const char* name) {
    const Comparison c = compareSets({name, test::solidNamed(name)}, sets, options);
    return isWorthKeeping(c.sets[1][0], c.sets[0][0]);
  };
  EXPECT_TRUE(keeps("I-beam"));
  EXPECT_TRUE(keeps("rod 1000:1"));
  EXPECT_FALSE(keeps("ball"));
  EXPECT_FALSE(keeps("rock"));
}

TEST(Comparison, IsTheSameTwiceButForTimes) {
  MeasureOptions options;
  options.poses = 5;
  options.runs = 1;
  options.runMs = 0;
  options.errorPercents = {5, 2};
  const std::vector<KindSet> sets{{"spheres", {VolumeKind::ball}},
                                  {"mixed", {test::kAllKinds.begin(), test::kAllKinds.end()}}};
  const NamedMesh beam{"I-beam", test::solidNamed("I-beam")};
  const Comparison once = compareSets(beam, sets, options), again = compareSets(beam, sets, options);
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (std::size_t i = 0; i < options.errorPercents.size(); ++i) {
      const AtError &a = once.sets[s][i], &b = again.sets[s][i];
      EXPECT_TRUE(a.isReached);
      EXPECT_EQ(a.nodes, b.nodes);
      EXPECT_EQ(a.bytes, b.bytes);
      EXPECT_EQ(a.operations, b.operations);
      EXPECT_EQ(a.pairs, b.pairs);
      EXPECT_GT(a.pairs, 0);
    }
}

}  // namespace
}  // namespace cairn::bench
