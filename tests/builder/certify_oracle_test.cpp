// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cover proof and error bound, each against brute force that shares no code with it, for random trees and balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/certify.h"
#include "certify/protrusion.h"
#include "distance_oracle.h"

namespace cairn::builder::certify_oracle_test {
namespace {

using test::uniform;

bool holds(const SphereTree& tree, NodeId node, const Vec3d& point) {
  const auto isIn = [&](const Sphere& s) {
    const double radius = s.radius;
    return lengthSq(point - (tree.origin() + Vec3d(s.center))) <= radius * radius;
  };
  return isIn(tree.sphere(node)) && isIn(tree.bound(node));
}

/// Whether a traversal that prunes at every ball without the point, stopped at `level`, still has a ball with it.
bool reached(const SphereTree& tree, NodeId node, std::uint32_t level, const Vec3d& point) {
  if (!holds(tree, node, point)) return false;
  if (level == 0 || tree.isLeaf(node)) return true;
  const NodeId first = tree.childFamily(node) * kFamilyWidth;
  for (NodeId child = first; child < first + tree.childCount(node); ++child)
    if (reached(tree, child, level - 1, point)) return true;
  return false;
}

bool covered(const SphereTree& tree, std::uint32_t level, const Vec3d& point) {
  const auto cut = tree.levelCut(level);
  return std::any_of(cut.begin(), cut.end(), [&](NodeId node) { return holds(tree, node, point); });
}

/// Corners, middles of edges and random points of every triangle: the corners are where a cover fails first.
template <class Expect>
void forSurfacePoints(const TriangleMesh& mesh, std::mt19937_64& engine, const Expect& expect) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(t);
    for (int i = 0; i < 3; ++i) {
      expect(c[i]);
      expect((c[i] + c[(i + 1) % 3]) * 0.5);
    }
    for (int i = 0; i < 20; ++i) {
      const double root = std::sqrt(uniform(engine)), along = uniform(engine);
      expect(c[0] * (1 - root) + c[1] * (root * (1 - along)) + c[2] * (root * along));
    }
  }
}

// A random point of a triangle is rounded and may lie this far beside it.
constexpr double kBeside = 1e-14;

/// Larger balls from elsewhere, which hold what the nodes' balls hold.
void addBounds(SphereTreeData& data, std::mt19937_64& engine) {
  for (const NodeData& node : data.nodes) {
    const Vec3 shift = Vec3(test::randomPoint(engine)) * (0.3F * node.radius);
    data.bounds.push_back({node.center + shift, 1.0001F * (node.radius + length(shift))});
  }
}

/// A tree some of whose balls were made smaller, by a little or a lot.
SphereTree shrunkenTree(const TriangleMesh& mesh, bool twoSpheres, std::mt19937_64& engine) {
  const double share = uniform(engine, 0, 0.2), least = uniform(engine, 0.5, 1);
  return test::tampered(test::quickTree(mesh), [&](SphereTreeData& data) {
    if (twoSpheres) addBounds(data, engine);
    for (Sphere& bound : data.bounds)
      if (uniform(engine) < share) bound.radius *= static_cast<float>(uniform(engine, least, 1));
    for (NodeData& node : data.nodes) {
      if (uniform(engine) >= share) continue;
      node.radius *= static_cast<float>(uniform(engine, least, 1));
      node.innerRadius = std::min(node.innerRadius, node.radius);
    }
  });
}

struct Outcomes {
  int proven = 0, refuted = 0;
};

void expectCoverAsBruteForce(const TriangleMesh& mesh, const SphereTree& tree, std::mt19937_64& engine,
                             Outcomes& outcomes) {
  const Certificate certificate = certify(tree, mesh).value();
  for (const LevelCertificate& level : certificate.levels) {
    bool allCovered = true, allReached = true;
    forSurfacePoints(mesh, engine, [&](const Vec3d& p) {
      allCovered = allCovered && covered(tree, level.level, p);
      allReached = allReached && reached(tree, tree.nodeAt(0), level.level, p);
    });
    // The proof's guard for rounding is far above `kBeside`: what it proves no sample may contradict.
    static_assert(kBeside < 1e-12);
    if (level.coverageProven) {
      EXPECT_TRUE(allCovered) << "level " << level.level;
    }
    if (level.reachableProven) {
      EXPECT_TRUE(allReached) << "level " << level.level;
    }
    EXPECT_TRUE(level.coverageProven || level.uncovered);
    EXPECT_TRUE(level.reachableProven || level.unreachable);
    if (level.uncovered && level.uncovered->gap > 0) {
      EXPECT_FALSE(covered(tree, level.level, level.uncovered->point)) << "level " << level.level;
    }
    ++(level.reachableProven ? outcomes.proven : outcomes.refuted);
  }
}

TEST(CoverProof, AgreesWithBruteForceOnRandomlyShrunkenTrees) {
  for (const bool twoSpheres : {false, true}) {
    Outcomes outcomes;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << (twoSpheres ? ", two spheres a node" : ""));
      std::mt19937_64 engine(seed);
      const TriangleMesh mesh = seed % 2 == 0 ? test::lumpyBall(3, seed) : test::torus(1, 0.4, 8, 5);
      expectCoverAsBruteForce(mesh, shrunkenTree(mesh, twoSpheres, engine), engine, outcomes);
    }
    // Both answers were put to the test.
    EXPECT_GT(outcomes.proven, 10);
    EXPECT_GT(outcomes.refuted, 10);
  }
}

/// The farthest of a grid of points in the ball from the solid, by brute force over all triangles in extended
/// precision. Every point of the ball is within `reach` of one of the grid.
struct GridMaximum {
  double farthest = 0, reach = 0;
};

GridMaximum farthestOnGrid(const test::DistanceOracle& oracle, const Vec3d& center, double radius) {
  constexpr int kHalf = 7;
  const double step = radius / kHalf;
  // A point of the ball is half a step from the grid in each coordinate; its neighbour there may lie outside the ball,
  // and is measured all the same.
  GridMaximum maximum{0, step * std::sqrt(3.0) / 2};
  for (int i = -kHalf; i <= kHalf; ++i)
    for (int j = -kHalf; j <= kHalf; ++j)
      for (int k = -kHalf; k <= kHalf; ++k) {
        const Vec3d offset = Vec3d(i, j, k) * step;
        if (length(offset) > radius + maximum.reach) continue;
        maximum.farthest = std::max(maximum.farthest, -oracle.depth(center + offset));
      }
  return maximum;
}

TEST(Protrusion, AgreesWithBruteForceOnRandomBalls) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 engine(seed);
    const TriangleMesh mesh = seed % 3 == 0 ? test::lumpyBall(2, seed)
                              : seed % 3 == 1
                                  ? test::torus(1, 0.4, 6, 4)
                                  : test::joined(test::meshOf(test::cuboid({2, 2, 2}, 1)),
                                                 test::flipped(test::meshOf(test::cuboid({1.4, 1.4, 1.4}, 1))));
    const SignedDistance solid(mesh);
    const test::DistanceOracle oracle{mesh};
    const Vec3d center = test::randomPoint(engine) * 1.2;
    const double radius = std::pow(10.0, uniform(engine, -1.5, 0.2));
    const ProtrusionTolerance tolerance = defaultProtrusionTolerance(solid);
    const CertifiedProtrusion found = certifiedProtrusion(solid, center, radius, tolerance);
    const GridMaximum grid = farthestOnGrid(oracle, center, radius);
    // The depth is 1-Lipschitz: ball and grid, which overlap in the middle only, differ by `reach` at most either way.
    EXPECT_GE(found.upper, grid.farthest - grid.reach);
    EXPECT_LE(found.lower, grid.farthest + grid.reach);
    // And the witness is as far as it says.
    EXPECT_NEAR(found.lower, std::max(0.0, -oracle.depth(found.witness)), 8 * solid.roundingBound(center));
  }
}

}  // namespace
}  // namespace cairn::builder::certify_oracle_test
