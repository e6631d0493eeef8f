// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/certify.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "builder_meshes.h"
#include "built_trees.h"
#include "certify/protrusion.h"

namespace cairn::builder::certify_test {
namespace {

using test::cuboid;
using test::meshOf;
using test::tampered;
using test::uniform;

constexpr std::uint64_t kSeed = 41;

Vec3d uniformInBall(std::mt19937_64& engine, const Vec3d& center, double radius) {
  for (;;) {
    const Vec3d p = test::randomPoint(engine);
    if (lengthSq(p) <= 1) return center + p * radius;
  }
}

// ---------------------------------------------------------------------------------------------- protrusion

/// The enclosure holds: no sampled point beats `upper`, the witness proves `lower`, and the two are as close as asked.
void expectEnclosed(const SignedDistance& solid, const Vec3d& center, double radius, std::mt19937_64& engine) {
  const ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid);
  const CertifiedProtrusion found = certifiedProtrusion(solid, center, radius, tolerance);
  const double rounding = 4 * solid.roundingBound(center + Vec3d{radius, radius, radius});
  ASSERT_LE(distance(found.witness, center), radius + rounding);
  ASSERT_NEAR(std::max(0.0, -solid.depth(found.witness)), found.lower, rounding);
  ASSERT_LE(found.upper, found.lower * (1 + tolerance.relative) + tolerance.absolute + 2 * rounding);
  ASSERT_LE(found.upper, std::max(0.0, radius - solid.depth(center)) + rounding);
  for (int i = 0; i < 400; ++i) {
    const Vec3d inside = uniformInBall(engine, center, radius);
    const Vec3d onSphere = center + normalized(test::randomPoint(engine) + Vec3d{1e-9, 0, 0}) * radius;
    ASSERT_LE(-solid.depth(inside), found.upper) << "seed " << kSeed;
    ASSERT_LE(-solid.depth(onSphere), found.upper + rounding) << "seed " << kSeed;
  }
}

TEST(Protrusion, EnclosesTheTruthForRandomBalls) {
  std::mt19937_64 engine(kSeed);
  for (const TriangleMesh& mesh :
       {test::lumpyBall(8, 1), test::torus(1, 0.3, 24, 12), meshOf(cuboid({1, 2, 0.3}, 2))}) {
    const SignedDistance solid(mesh);
    for (int i = 0; i < 60; ++i)
      expectEnclosed(solid, test::randomPoint(engine) * 1.5, std::pow(10.0, uniform(engine, -3, 0.3)), engine);
  }
}

TEST(Protrusion, OfABallAroundACubeIsExact) {
  // From the centre of a unit cube a ball of radius 1 reaches farthest over the middle of a face: 1 - 1/2.
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 2));
  const SignedDistance solid(cube);
  const CertifiedProtrusion found = certifiedProtrusion(solid, {0, 0, 0}, 1, {1e-6, 1e-6, 1'000'000});
  EXPECT_NEAR(found.upper, 0.5, 1e-5);
  EXPECT_NEAR(found.lower, 0.5, 1e-5);
}

TEST(Protrusion, FindsAMaximumInsideTheBall) {
  // In a cubic cavity of half size 1 the distance to the solid is 1 - max |x_i|: largest, 1, in the middle of the
  // cavity, which lies inside this ball, not on its sphere.
  const TriangleMesh hollow = test::joined(meshOf(cuboid({4, 4, 4}, 2)), test::flipped(meshOf(cuboid({2, 2, 2}, 2))));
  const SignedDistance solid(hollow);
  const CertifiedProtrusion found = certifiedProtrusion(solid, {0.3, 0.1, 0}, 0.5, {1e-3, 1e-4, 1'000'000});
  EXPECT_GE(found.upper, 1);
  EXPECT_NEAR(found.upper, 1, 2e-3);
  EXPECT_NEAR(found.lower, 1, 2e-3);
}

TEST(Protrusion, OfABallInsideIsZero) {
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 1));
  const SignedDistance solid(cube);
  const CertifiedProtrusion found = certifiedProtrusion(solid, {0.1, 0, 0}, 0.8, defaultProtrusionTolerance(solid));
  EXPECT_EQ(found.upper, 0);
  EXPECT_EQ(found.lower, 0);
  EXPECT_NEAR(found.depth, 0.9, 1e-14);
}

TEST(Protrusion, OfAPointOutsideIsItsDistance) {
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 1));
  const SignedDistance solid(cube);
  const CertifiedProtrusion found = certifiedProtrusion(solid, {4, 0, 0}, 0, defaultProtrusionTolerance(solid));
  const double guard = 4 * solid.roundingBound({4, 0, 0});
  EXPECT_GE(found.upper, 3);
  EXPECT_LE(found.upper, 3 + guard);
  EXPECT_LE(found.lower, 3);
  EXPECT_GE(found.lower, 3 - guard);
}

TEST(Protrusion, StopsAtTheMostQueriesWithAValidBound) {
  const TriangleMesh mesh = test::lumpyBall(8, 3);
  const SignedDistance solid(mesh);
  const CertifiedProtrusion exact = certifiedProtrusion(solid, {0.2, 0, 0}, 1, {1e-4, 1e-5, 1'000'000});
  double last = 1e300;
  for (const std::uint32_t most : {1U, 20U, 100U, 1000U}) {
    const CertifiedProtrusion found = certifiedProtrusion(solid, {0.2, 0, 0}, 1, {1e-4, 1e-5, most});
    EXPECT_GE(found.upper, exact.lower);
    EXPECT_LE(found.upper, last);
    last = found.upper;
  }
}

// ---------------------------------------------------------------------------------------------- certificates

/// The smallest signed distance of a point to a ball of a level cut: positive when it lies outside all.
double gapOfPoint(const SphereTree& tree, std::uint32_t level, const Vec3d& point) {
  double gap = 1e300;
  for (const NodeId node : tree.levelCut(level)) {
    const Sphere s = tree.sphere(node);
    gap = std::min(gap, distance(point, tree.origin() + Vec3d(s.center)) - static_cast<double>(s.radius));
  }
  return gap;
}

/// Makes the ball smaller, and the inner one with it, which must not exceed it.
void shrink(NodeData& node, float factor) {
  node.radius *= factor;
  node.innerRadius = std::min(node.innerRadius, node.radius);
}

TEST(Certify, ProvesBuiltTrees) {
  for (const TriangleMesh& mesh : {meshOf(cuboid({1, 2, 3}, 1)), test::lumpyBall(6, 2), test::torus(1, 0.3, 16, 8)}) {
    const SphereTree tree = test::quickTree(mesh);
    const Result<Certificate> certificate = certify(tree, mesh);
    ASSERT_TRUE(certificate.ok());
    const auto failures = certificate.value().failures(tree);
    EXPECT_TRUE(failures.empty()) << failures.front();
    ASSERT_EQ(certificate.value().levels.size(), tree.depth() + 1);
    ASSERT_EQ(certificate.value().nodes.size(), tree.nodeCount());
    for (const LevelCertificate& level : certificate.value().levels) {
      EXPECT_TRUE(level.coverageProven && level.reachableProven);
      EXPECT_EQ(level.spheres, tree.levelCut(level.level).size());
      EXPECT_LE(level.rmsProtrusion, level.maxProtrusion);
    }
  }
}

// Edges of equal length are cut otherwise in the body's frame than in the mesh's: a cover the builder knows of then
// overlaps by no more than its guard where the proof cuts.
TEST(Certify, ProvesBuiltTreesOfEqualEdges) {
  const TriangleMesh corner =
      meshOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    BuildOptions options;
    options.seed = seed;
    const auto tree = buildTree(corner, options);
    ASSERT_TRUE(tree) << tree.error().message;
    const auto certificate = certify(tree.value(), corner);
    ASSERT_TRUE(certificate) << certificate.error().message;
    for (const std::string& failure : certificate.value().failures(tree.value()))
      ADD_FAILURE() << seed << ": " << failure;
  }
}

TEST(Certify, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::lumpyBall(6, 2);
  const SphereTree broken = tampered(test::quickTree(mesh), [](SphereTreeData& d) {
    for (NodeData& n : d.nodes) shrink(n, 0.9F);
  });
  std::vector<std::vector<std::string>> reports;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    reports.push_back(certify(broken, mesh).value().failures(broken));
  }
  EXPECT_FALSE(reports[0].empty());
  EXPECT_EQ(reports[0], reports[1]);
  EXPECT_EQ(reports[0], reports[2]);
}

TEST(Certify, FindsAGapAndGivesAWitness) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  const SphereTree tree = test::quickTree(mesh);
  // The leaf that holds the corner alone is found by shrinking each in turn: some leave a gap, none goes unnoticed.
  int gaps = 0;
  for (std::uint32_t i = 1; i < tree.nodeCount(); ++i) {
    if (!tree.isLeaf(tree.nodeAt(i))) continue;
    const SphereTree broken = tampered(tree, [&](SphereTreeData& d) { shrink(d.nodes[i], 0.5F); });
    const Certificate certificate = certify(broken, mesh).value();
    const LevelCertificate& leaves = certificate.levels.back();
    if (leaves.uncovered && leaves.uncovered->gap > 0) {
      ++gaps;
      const double gap = gapOfPoint(broken, tree.depth(), leaves.uncovered->point);
      EXPECT_NEAR(gap, leaves.uncovered->gap, 1e-9);
      EXPECT_GT(gap, 0);
      EXPECT_FALSE(leaves.coverageProven);
      EXPECT_FALSE(certificate.failures(broken).empty());
    }
    if (leaves.coverageProven) {
      // Cross-check a proof by sampling all over the surface.
      std::mt19937_64 engine(kSeed + i);
      for (int k = 0; k < 2000; ++k) {
        const auto c = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
        const double root = std::sqrt(uniform(engine)), along = uniform(engine);
        const Vec3d p = c[0] * (1 - root) + c[1] * (root * (1 - along)) + c[2] * (root * along);
        ASSERT_LE(gapOfPoint(broken, tree.depth(), p), 1e-12) << "seed " << kSeed + i;
      }
    }
  }
  EXPECT_GT(gaps, 0);
}

TEST(Certify, TellsCoveredFromReachable) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  const SphereTree tree = test::quickTree(mesh);
  // A parent shrunk: the leaves still cover, but a traversal that prunes at the parent misses some of them.
  const SphereTree broken = tampered(tree, [](SphereTreeData& d) { shrink(d.nodes[1], 0.6F); });
  ASSERT_FALSE(broken.isLeaf(broken.nodeAt(1)));
  const Certificate certificate = certify(broken, mesh).value();
  EXPECT_TRUE(certificate.levels[0].reachableProven);
  EXPECT_TRUE(certificate.levels[2].coverageProven);
  EXPECT_FALSE(certificate.levels[2].reachableProven);
  EXPECT_FALSE(certificate.levels[1].coverageProven);
}

// Of two spheres a node either may leave the gap, and the error is that of the one which answers.
TEST(Certify, OfTwoSpheresANode_JudgesTheCoverOfBothAndTheErrorOfOne) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  const SphereTree one = test::quickTree(mesh);
  const SphereTree two = tampered(one, [](SphereTreeData& d) {
    for (const NodeData& n : d.nodes) d.bounds.push_back({n.center, 2 * n.radius});
  });
  EXPECT_EQ(certify(two, mesh).value().failures(two), std::vector<std::string>{})
      << "a large bound has no error of its own";
  const auto isRefuted = [&](const auto& change) {
    const SphereTree broken = tampered(two, change);
    const Certificate certificate = certify(broken, mesh).value();
    EXPECT_TRUE(certificate.levels[0].reachableProven);
    return !certificate.levels[1].coverageProven && !certificate.levels[2].reachableProven &&
           certificate.levels[2].coverageProven;
  };
  EXPECT_TRUE(isRefuted([](SphereTreeData& d) { shrink(d.nodes[1], 0.6F); }));
  EXPECT_TRUE(isRefuted([](SphereTreeData& d) { d.bounds[1].radius *= 0.3F; }));
  EXPECT_TRUE(isRefuted([](SphereTreeData& d) { d.bounds[1].center.x += 3 * d.bounds[1].radius; }));
}

TEST(Certify, RefutesAnErrorThatIsTooSmall) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  const SphereTree tree = test::quickTree(mesh);
  const SphereTree broken = tampered(tree, [](SphereTreeData& d) { d.nodes[3].error *= 0.9F; });
  const Certificate certificate = certify(broken, mesh).value();
  EXPECT_FALSE(certificate.nodes[3].errorHolds);
  const SignedDistance solid(mesh);
  EXPECT_GT(-solid.depth(certificate.nodes[3].witness), broken.data().nodes[3].error);
  const auto failures = certificate.failures(broken);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].find("node 3: its error is"), 0U) << failures[0];
}

// Balls that are the same are searched once: a tree of nothing else, each larger than the mesh, took 200 times as long
// as an honest one.
TEST(Certify, JudgesNodesOfOneBallByWhatEachSays) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  const SphereTree same = tampered(test::quickTree(mesh), [](SphereTreeData& d) {
    const NodeData root = d.nodes[0];
    for (NodeData& n : d.nodes) {
      n.center = root.center;
      n.radius = n.error = 2 * root.radius;
      n.innerRadius = 0;
    }
  });
  const SphereTree broken = tampered(same, [](SphereTreeData& d) {
    d.nodes[0].error = d.nodes[3].error /= 4;
    d.nodes[5].innerRadius = d.nodes[5].radius;
  });
  const SignedDistance solid(mesh);
  const CertifiedProtrusion alone =
      certifiedProtrusion(solid, broken.origin() + Vec3d(broken.data().nodes[0].center), broken.data().nodes[0].radius,
                          defaultProtrusionTolerance(solid));
  const Certificate certificate = certify(broken, mesh).value();
  for (std::size_t i = 0; i < certificate.nodes.size(); ++i) {
    const NodeCertificate& node = certificate.nodes[i];
    EXPECT_EQ(node.protrusionUpper, alone.upper) << i;
    EXPECT_EQ(node.protrusionLower, alone.lower) << i;
    EXPECT_EQ(node.errorHolds, i != 0 && i != 3) << i;
    EXPECT_EQ(node.errorProven, i != 0 && i != 3) << i;
    EXPECT_EQ(node.innerHolds, i != 5) << i;
  }
}

TEST(Certify, RefutesAnInnerRadiusThatIsTooLarge) {
  const TriangleMesh mesh = meshOf(test::ball(1, 8));
  const SphereTree tree = test::quickTree(mesh);
  ASSERT_GT(tree.data().nodes[0].innerRadius, 0);
  const SphereTree broken = tampered(tree, [](SphereTreeData& d) { d.nodes[0].innerRadius *= 1.01F; });
  const auto failures = certify(broken, mesh).value().failures(broken);
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].find("node 0: its inner radius is"), 0U) << failures[0];
}

/// The one failure of a tree that is right but for `change`.
template <class Change>
std::string failureAfter(const TriangleMesh& mesh, const Change& change) {
  const SphereTree broken = tampered(test::quickTree(mesh), change);
  const auto failures = certify(broken, mesh).value().failures(broken);
  EXPECT_EQ(failures.size(), 1U);
  return failures.empty() ? std::string() : failures.front();
}

TEST(Certify, RefutesAStoredMeshThatDiffers) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { d.vertices[7].x *= 1.00001F; }).find("vertex 7 of the tree"),
            0U);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { std::swap(d.triangles[5][0], d.triangles[5][1]); })
                .find("triangle 5 of the tree"),
            0U);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { d.vertices.emplace_back(); }).find("the tree stores"), 0U);
}

TEST(Certify, RefutesMassPropertiesThatDiffer) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { d.mass.volume *= 1 + 1e-8; }).find("the volume is"), 0U);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { d.mass.centerOfMass.y += 1e-6; }).find("the centre of mass"),
            0U);
  EXPECT_EQ(failureAfter(mesh, [](SphereTreeData& d) { d.mass.inertia(0, 1) += 1e-6; }).find("the inertia"), 0U);
  EXPECT_EQ(
      failureAfter(mesh, [](SphereTreeData& d) { d.mass.principalMoments.z *= 1.00001; }).find("the principal moments"),
      0U);
}

TEST(Certify, RefutesANormalConeThatIsTooNarrow) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  const SphereTree tree = test::quickTree(mesh);
  std::uint32_t narrow = 0;
  while (tree.data().nodes[narrow].normalCone.cosine < 0) ++narrow;
  const std::string failure = failureAfter(mesh, [&](SphereTreeData& d) { d.nodes[narrow].normalCone.cosine = 1; });
  EXPECT_EQ(failure.find("node " + std::to_string(narrow) + ": its normal cone"), 0U) << failure;
}

TEST(Certify, RefutesASupportPointOutsideItsBall) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  const std::string failure = failureAfter(mesh, [](SphereTreeData& d) {
    d.supportPoints[d.nodes[3].firstSupport] = {9, 9, 9};
  });
  EXPECT_EQ(failure.find("node 3: its support point 0"), 0U) << failure;
}

TEST(Certify, RefutesATreeOfAnotherMesh) {
  const TriangleMesh small = meshOf(cuboid({1, 1, 1}, 1)), large = meshOf(cuboid({1.2, 1, 1}, 1));
  const SphereTree tree = test::quickTree(small);
  EXPECT_FALSE(certify(tree, large).value().levels.back().coverageProven);
}

TEST(Certify, StopsWhenToldTo) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  const SphereTree tree = test::quickTree(mesh);
  int calls = 0;
  for (int allowed = 0;; ++allowed) {
    calls = 0;
    const Result<Certificate> result = certify(tree, mesh, [&](std::string_view, double) { return calls++ < allowed; });
    if (result.ok()) break;
    EXPECT_EQ(result.error().message, kCancelled);
    EXPECT_EQ(calls, allowed + 1);
  }
  EXPECT_GT(calls, 3);
}

TEST(Certify, ProgressNeverFalls) {
  const TriangleMesh mesh = test::lumpyBall(5, 8);
  double last = 0;
  ASSERT_TRUE(certify(test::quickTree(mesh), mesh, [&](std::string_view, double fraction) {
                EXPECT_GE(fraction, last);
                EXPECT_LE(fraction, 1);
                last = fraction;
                return true;
              }).ok());
}

}  // namespace
}  // namespace cairn::builder::certify_test
