// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "balls/point_set.h"
#include "balls/ritter_ball.h"
#include "builder_meshes.h"
#include "medial/gap_crossing.h"
#include "medial/hubbard_medial.h"
#include "spheres/hubbard.h"
#include "spheres/hubbard_error.h"
#include "surface/planar_clusters.h"

namespace cairn::builder::hubbard_test {
namespace {

// Lengths in solids of size 1 to 3, each rounded by 2^-53 of its size a few times over.
constexpr double kRounding = 1e-12;

PlanarClusters clustersOf(const TriangleMesh& mesh) {
  return planarClustersOf(mesh, sortedHalfEdges(mesh));
}

double areaOfMesh(const TriangleMesh& mesh) {
  double area = 0;
  for (const Piece& piece : piecesOf(mesh)) area += areaOf(piece);
  return area;
}

std::vector<TriangleMesh> solids() {
  return {test::meshOf(test::cuboid({1, 1, 1}, 2)), test::cylinder(0.3, 1, 10), test::torus(1, 0.3, 16, 8),
          test::lumpyBall(2, 7)};
}

TEST(PlanarClusters, Cuboid_HasItsSixFaces) {
  const PlanarClusters clusters = clustersOf(test::meshOf(test::cuboid({1, 2, 3}, 3)));
  ASSERT_EQ(clusters.count(), 6U);
  for (const auto& triangles : clusters.triangles) EXPECT_EQ(triangles.size(), 18U);
}

TEST(PlanarClusters, AnyMesh_PutsEveryTriangleInOnePlane) {
  for (const TriangleMesh& mesh : solids()) {
    const PlanarClusters clusters = clustersOf(mesh);
    std::size_t total = 0;
    for (std::uint32_t c = 0; c < clusters.count(); ++c) {
      total += clusters.triangles[c].size();
      for (const std::uint32_t t : clusters.triangles[c]) {
        EXPECT_EQ(clusters.ofTriangle[t], c);
        const auto [p, q, r] = mesh.corners(t);
        EXPECT_GE(dot(normalized(cross(q - p, r - p)), clusters.normals[c]), 0.9998);  // the cosine of 1.1 degrees
      }
    }
    EXPECT_EQ(total, mesh.triangles.size());
  }
}

TEST(RelaxedSamples, EveryPoint_LiesOnItsClusters) {
  for (const TriangleMesh& mesh : solids()) {
    const SignedDistance solid(mesh);
    const PlanarClusters clusters = clustersOf(mesh);
    const auto samples = relaxedSamples(mesh, sortedHalfEdges(mesh), clusters, 200, 3);
    EXPECT_GE(samples.size(), 200U);
    for (const ClusterSample& s : samples) {
      ASSERT_FALSE(s.clusters.empty());
      for (const std::uint32_t c : s.clusters) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t t : clusters.triangles[c])
          nearest = std::min(nearest, solid.distanceToTriangle(t, s.point));
        EXPECT_LE(nearest, kRounding);
      }
    }
  }
}

// A needle has a hundred million spacings along its edges.
TEST(RelaxedSamples, Needle_HasNoMoreThanFiveTimesThoseAskedFor) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1e9}, 1));
  const auto samples = relaxedSamples(mesh, sortedHalfEdges(mesh), clustersOf(mesh), 100, 3);
  EXPECT_GE(samples.size(), 400U);
  EXPECT_LE(samples.size(), 100 + 4 * 100 + mesh.vertices.size());
}

TEST(RelaxedSamples, OneFace_IsSpreadMoreEvenlyThanAtRandom) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 1}, 1));
  const auto samples = relaxedSamples(mesh, sortedHalfEdges(mesh), clustersOf(mesh), 600, 5);
  double sum = 0;
  std::size_t count = 0;
  for (const ClusterSample& s : samples) {
    if (s.clusters.size() > 1) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const ClusterSample& other : samples)
      if (&other != &s) nearest = std::min(nearest, distance(s.point, other.point));
    sum += nearest;
    ++count;
  }
  // Independent points are half a spacing sqrt(A / n) from the nearest on average, a square grid's one whole.
  EXPECT_GT(sum / static_cast<double>(count), 0.65 * std::sqrt(areaOfMesh(mesh) / 600));
}

TEST(GapCrossing, ThinSlabSampledOnOneSide_IsSampledOnTheOther) {
  const TriangleMesh mesh = test::meshOf(test::cuboid({1, 1, 0.05}, 1));
  const PlanarClusters clusters = clustersOf(mesh);
  const TriangleHierarchy hierarchy(mesh);
  std::vector<ClusterSample> samples;
  const auto clusterFacing = [&](double z) {
    for (std::uint32_t c = 0; c < clusters.count(); ++c)
      if (clusters.normals[c].z * z > 0.5) return c;
    return ~0U;
  };
  const std::uint32_t top = clusterFacing(1), bottom = clusterFacing(-1);
  for (int i = 0; i < 100; ++i)
    samples.push_back({{(i % 10 + 0.51) / 10 - 0.5, (i / 10 + 0.52) / 10 - 0.5, 0.025}, {top}});
  samples.push_back({{0.01, 0.02, -0.025}, {bottom}});
  VoronoiDiagram diagram(boundsOf(mesh));
  for (const ClusterSample& s : samples) ASSERT_TRUE(diagram.insert(s.point));
  const auto added = gapCrossingSamples(diagram, samples, mesh, hierarchy, clusters, 0.05);
  std::size_t below = 0;
  for (const ClusterSample& s : added) {
    ASSERT_EQ(s.clusters.size(), 1U);
    if (s.clusters[0] != bottom) continue;
    ++below;
    EXPECT_NEAR(s.point.z, -0.025, kRounding);
  }
  // The cells of the hundred points reach through the slab; each inner one has four neighbours to say so.
  EXPECT_GE(below, 60U);
}

TEST(HubbardMedial, Spheres_AreEmptyAndPassThroughTheirPoints) {
  for (const TriangleMesh& mesh : solids()) {
    const SignedDistance solid(mesh);
    const HubbardMedial medial = hubbardMedialOf(solid, 150, 1);
    EXPECT_GT(medial.spheres.size(), 100U);
    std::vector<Vec3d> list;
    for (const ClusterSample& s : medial.samples) list.push_back(s.point);
    const PointSet points(list);
    std::vector<double> outside(list.size());
    for (std::uint32_t i = 0; i < medial.spheres.size(); ++i) {
      const HubbardMedial::Sphere& sphere = medial.spheres[i];
      EXPECT_GT(sphere.ball.depth, 0);
      // The centre of four nearly coplanar points is rounded by much more than they are: half of the digits are left.
      for (const std::uint32_t s : sphere.samples)
        EXPECT_NEAR(distance(list[s], sphere.ball.center), sphere.ball.radius, 1e-7);
      points.distances(sphere.ball.center, sphere.ball.radius, outside);
      EXPECT_GE(*std::min_element(outside.begin(), outside.end()), -1e-7);
      for (const std::uint32_t n : sphere.neighbours) {
        const auto& other = medial.spheres[n];
        EXPECT_TRUE(std::binary_search(other.neighbours.begin(), other.neighbours.end(), i));
        std::vector<std::uint32_t> common;
        std::set_intersection(sphere.samples.begin(), sphere.samples.end(), other.samples.begin(), other.samples.end(),
                              std::back_inserter(common));
        EXPECT_EQ(common.size(), 3U);
      }
    }
  }
}

TEST(NormalStandOff, PointRaisedByIt_LiesOnTheBall) {
  std::mt19937_64 engine(41);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3d center = test::randomPoint(engine), normal = normalized(test::randomPoint(engine));
    const Vec3d point = center + normalized(test::randomPoint(engine)) * test::uniform(engine, 0.0, 1.0);
    const double standOff = normalStandOff(center, 1, point, normal);
    EXPECT_GE(standOff, 0);
    EXPECT_NEAR(distance(point + normal * standOff, center), 1, kRounding) << "seed 41, trial " << trial;
  }
}

TEST(RitterBall, AnyPoints_AreHeldByLessThanTwiceTheSmallest) {
  std::mt19937_64 engine(43);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3d> points(1 + engine() % 60);
    for (Vec3d& p : points) p = test::randomPoint(engine);
    const EnclosingBall ball = ritterBall(points);
    for (const Vec3d& p : points) EXPECT_LE(distance(p, ball.center), ball.radius);
    // The centre stays in the points' hull and every radius is at most their diameter, which is twice the smallest's.
    EXPECT_LE(ball.radius, 2 * smallestEnclosingBall(points).radius + kRounding) << "seed 43, trial " << trial;
  }
}

TEST(HubbardMerge, Groups_PartTheMembersAndHoldTheirPoints) {
  for (const TriangleMesh& mesh : solids()) {
    const SignedDistance solid(mesh);
    const HubbardMedial medial = hubbardMedialOf(solid, 150, 2);
    std::vector<std::uint32_t> all(medial.spheres.size());
    std::iota(all.begin(), all.end(), 0U);
    // A tenth of the spheres leaves most of them without neighbours.
    std::vector<std::uint32_t> few;
    for (const std::uint32_t i : all)
      if (i % 10 == 0) few.push_back(i);
    for (const auto& members : {all, few})
      for (const std::size_t count : {1, 2, 8}) {
        const auto groups = mergeHubbard(medial, members, count, SolidDepth(solid));
        EXPECT_EQ(groups.size(), std::min(count, members.size()));
        std::vector<std::uint32_t> seen;
        for (const HubbardGroup& group : groups) {
          seen.insert(seen.end(), group.members.begin(), group.members.end());
          for (const std::uint32_t m : group.members)
            for (const std::uint32_t s : medial.spheres[m].samples)
              EXPECT_LE(distance(medial.samples[s].point, group.ball.center), group.ball.radius + 1e-7);
        }
        std::sort(seen.begin(), seen.end());
        EXPECT_EQ(seen, members);
      }
  }
}

/// Of one group, for one piece: the distance to its nearest medial sphere, and the growth that its ball needs.
struct Claim {
  double gap = std::numeric_limits<double>::infinity(), growth = 0;
};

std::vector<Claim> claimsOn(const Piece& piece, const std::vector<HubbardGroup>& groups, const HubbardMedial& medial) {
  std::vector<Claim> claims(groups.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const std::uint32_t m : groups[k].members) {
      const Ball& ball = medial.spheres[m].ball;
      claims[k].gap = std::min(claims[k].gap, distance(centroidOf(piece), ball.center) - ball.radius);
    }
    for (const Vec3d& c : piece.corners)
      claims[k].growth = std::max(claims[k].growth, distance(c, groups[k].ball.center) - groups[k].ball.radius);
  }
  return claims;
}

TEST(HubbardMerge, Parts_GoToTheNearestSphereUnlessItsBallWouldGrowAndCoverEverything) {
  const TriangleMesh mesh = test::lumpyBall(2, 9);
  const SignedDistance solid(mesh);
  const HubbardMedial medial = hubbardMedialOf(solid, 150, 2);
  std::vector<std::uint32_t> all(medial.spheres.size());
  std::iota(all.begin(), all.end(), 0U);
  const auto groups = mergeHubbard(medial, all, 8, SolidDepth(solid));
  Pieces pieces = piecesOf(mesh);
  refinePieces(pieces, 600);
  const std::vector<Pieces> parts = divideByOwners(medial, groups, pieces);
  std::size_t total = 0, elsewhere = 0;
  for (std::size_t g = 0; g < parts.size(); ++g) {
    total += parts[g].size();
    for (const Piece& piece : parts[g]) {
      const std::vector<Claim> claims = claimsOn(piece, groups, medial);
      const Claim nearest = *std::ranges::min_element(claims, {}, &Claim::gap);
      double least = nearest.growth;
      for (const Claim& c : claims) least = std::min(least, std::max(c.growth, c.gap - nearest.gap));
      EXPECT_LE(std::max(claims[g].growth, claims[g].gap - nearest.gap), least + kRounding);
      elsewhere += claims[g].gap > nearest.gap + kRounding ? 1 : 0;
    }
  }
  EXPECT_EQ(total, pieces.size());
  EXPECT_GT(elsewhere, 0U);
}

}  // namespace
}  // namespace cairn::builder::hubbard_test
