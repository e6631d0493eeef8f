// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include "balls/farthest_sample.h"
#include "balls/piece.h"
#include "builder_meshes.h"
#include "medial/medial_spheres.h"
#include "medial/voronoi_diagram.h"

namespace cairn::builder::medial_test {
namespace {

constexpr Bounds kUnitBox{{-1, -1, -1}, {1, 1, 1}};

/// A Voronoi vertex has its four sites at one distance and no site nearer. Its position is rounded: an error d in it
/// changes distances by d, and for sites in general position d stays below 1e-8 of the reach; flat quadruples are left
/// out.
void expectEmptySpheres(const VoronoiDiagram& diagram) {
  std::size_t checked = 0;
  for (const VoronoiVertex& vertex : diagram.vertices()) {
    if (!vertex.alive || !isFinite(vertex.position) || length(vertex.position) > 100) continue;
    const double reach = distance(vertex.position, diagram.site(vertex.sites[0]));
    const double tolerance = 1e-8 * (1 + reach);
    for (const std::uint32_t site : vertex.sites)
      EXPECT_NEAR(distance(vertex.position, diagram.site(site)), reach, tolerance);
    for (std::uint32_t s = 0; s < diagram.siteCount(); ++s)
      EXPECT_GE(distance(vertex.position, diagram.site(s)), reach - tolerance) << "site " << s;
    ++checked;
  }
  EXPECT_GT(checked, diagram.siteCount());
}

TEST(VoronoiDiagram, RandomSites_NoSiteInsideAVertexSphere) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    VoronoiDiagram diagram(kUnitBox);
    for (int i = 0; i < 150; ++i) ASSERT_TRUE(diagram.insert(test::randomPoint(engine)));
    expectEmptySpheres(diagram);
  }
}

using Quadruple = std::array<std::uint32_t, 4>;
using Wide = BasicVec3<long double>;

/// Six times the signed volume of a tetrahedron.
long double volumeOf(const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
  return dot(b - a, cross(c - a, d - a));
}

/// Whether `e` lies in the sphere through a, b, c and d: the sign of a determinant, not a comparison of radii.
bool inSphere(const Wide& a, const Wide& b, const Wide& c, const Wide& d, const Wide& e) {
  const std::array<Wide, 4> p{a - e, b - e, c - e, d - e};
  long double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const Wide &u = p[(i + 1) % 4], &v = p[(i + 2) % 4], &w = p[(i + 3) % 4];
    sum += (i % 2 == 0 ? 1 : -1) * lengthSq(p[i]) * dot(u, cross(v, w));
  }
  return volumeOf(a, b, c, d) > 0 ? sum > 0 : sum < 0;
}

/// All quadruples of sites without another site in their sphere.
std::set<Quadruple> delaunayByTrial(const VoronoiDiagram& diagram) {
  const std::uint32_t n = diagram.siteCount();
  const auto site = [&](std::uint32_t i) { return Wide(diagram.site(i)); };
  std::set<Quadruple> found;
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c)
        for (std::uint32_t d = c + 1; d < n; ++d) {
          bool empty = true;
          for (std::uint32_t e = 0; empty && e < n; ++e)
            empty = e == a || e == b || e == c || e == d || !inSphere(site(a), site(b), site(c), site(d), site(e));
          if (empty) found.insert({a, b, c, d});
        }
  return found;
}

TEST(VoronoiDiagram, RandomSites_AreThoseOfAllEmptyQuadruples) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 engine(seed);
    VoronoiDiagram diagram(kUnitBox);
    for (int i = 0; i < 14; ++i) ASSERT_TRUE(diagram.insert(test::randomPoint(engine)));
    std::set<Quadruple> vertices;
    for (const VoronoiVertex& vertex : diagram.vertices()) {
      if (!vertex.alive) continue;
      Quadruple sites = vertex.sites;
      std::ranges::sort(sites);
      EXPECT_TRUE(vertices.insert(sites).second);
    }
    std::set<Quadruple> expected = delaunayByTrial(diagram);
    // The eight enclosing sites are the corners of a cube: a sphere through three of a face holds the fourth too, and
    // which of the quadruples are taken is free.
    const auto isFree = [](const Quadruple& q) { return q[2] < VoronoiDiagram::kEnclosingSites; };
    std::erase_if(vertices, isFree);
    std::erase_if(expected, isFree);
    EXPECT_GT(expected.size(), 14U);
    EXPECT_EQ(vertices, expected);
  }
}

TEST(VoronoiDiagram, GridSites_NoSiteInsideAVertexSphere) {
  VoronoiDiagram diagram(kUnitBox);
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) ASSERT_TRUE(diagram.insert(Vec3d(x, y, z) * 0.5));
  for (const VoronoiVertex& vertex : diagram.vertices()) {
    if (!vertex.alive || !isFinite(vertex.position)) continue;
    const double reach = distance(vertex.position, diagram.site(vertex.sites[0]));
    // A flat quadruple of grid points has no sphere of its own; those that do have one within the box.
    if (reach > 0.5) continue;
    for (std::uint32_t s = 0; s < diagram.siteCount(); ++s)
      EXPECT_GE(distance(vertex.position, diagram.site(s)), reach - 1e-12);
  }
}

TEST(VoronoiDiagram, RepeatedSite_IsRefusedAndChangesNothing) {
  VoronoiDiagram diagram(kUnitBox);
  ASSERT_TRUE(diagram.insert({0.1, 0.2, 0.3}));
  const std::size_t vertices = diagram.vertices().size();
  EXPECT_FALSE(diagram.insert({0.1, 0.2, 0.3}));
  EXPECT_EQ(diagram.vertices().size(), vertices);
}

TEST(VoronoiDiagram, Insert_NamesWhatItEndedAndCreated) {
  std::mt19937_64 engine(7);
  VoronoiDiagram diagram(kUnitBox);
  for (int i = 0; i < 50; ++i) {
    std::vector<bool> before;
    for (const VoronoiVertex& v : diagram.vertices()) before.push_back(v.alive);
    ASSERT_TRUE(diagram.insert(test::randomPoint(engine)));
    EXPECT_EQ(diagram.firstOfLastInsert(), before.size());
    for (const std::uint32_t ended : diagram.endedByLastInsert()) {
      EXPECT_TRUE(before[ended]);
      before[ended] = false;
    }
    for (std::size_t v = 0; v < before.size(); ++v) EXPECT_EQ(diagram.vertices()[v].alive, before[v]);
    for (std::size_t v = before.size(); v < diagram.vertices().size(); ++v)
      EXPECT_NE(std::ranges::find(diagram.vertices()[v].sites, diagram.siteCount() - 1),
                diagram.vertices()[v].sites.end());
  }
}

struct Sampled {
  explicit Sampled(TriangleMesh m) : mesh(std::move(m)), solid(mesh) {
    Pieces pieces = piecesOf(mesh);
    refinePieces(pieces, 1500);
    const std::vector<Vec3d> corners = cornersOf(pieces);
    points = PointSet(corners);
    sites = farthestPointSample(corners, 60, 0);
    for (const Piece& piece : pieces) spacing = std::max(spacing, std::sqrt(longestEdgeSq(piece)));
  }
  TriangleMesh mesh;
  SignedDistance solid;
  PointSet points;
  std::vector<Vec3d> sites;
  double spacing = 0;
};

TEST(MedialSpheres, Refinement_ReachesTheGoal) {
  const Sampled s(test::lumpyBall(2, 5));
  const MedialGoal goal{.minSpheres = 100, .maxStandOff = 0.1, .maxOutside = 0.1, .maxInsertions = 2000};
  const MedialSpheres medial = approximateMedialAxis(s.solid, s.points, s.spacing, s.sites, goal);
  EXPECT_GE(medial.inside.size(), goal.minSpheres);
  for (const Ball& ball : medial.inside) {
    EXPECT_LE(ball.standOff(), goal.maxStandOff);
    EXPECT_GT(ball.depth, 0);
    EXPECT_DOUBLE_EQ(ball.depth, s.solid.depth(ball.center));
  }
  for (const Ball& ball : medial.outside) {
    EXPECT_LE(ball.depth, 0);
    EXPECT_GE(ball.depth, -goal.maxOutside);
  }
}

TEST(MedialSpheres, InsideAndCoverageSpheres_HoldEveryPoint) {
  for (const TriangleMesh& mesh :
       {test::meshOf(test::cuboid({1, 1, 1}, 2)), test::lumpyBall(2, 9), test::torus(1, 0.3, 24, 12)}) {
    const Sampled s(mesh);
    const MedialGoal goal{.minSpheres = 100, .maxStandOff = 0.2, .maxOutside = 0, .maxInsertions = 300};
    const MedialSpheres medial = approximateMedialAxis(s.solid, s.points, s.spacing, s.sites, goal);
    for (std::size_t p = 0; p < s.points.size(); ++p) {
      const auto holds = [&](const Ball& ball) { return distance(ball.center, s.points[p]) <= ball.radius; };
      EXPECT_TRUE(std::ranges::any_of(medial.inside, holds) || std::ranges::any_of(medial.coverage, holds))
          << "point " << p;
    }
  }
}

TEST(MedialSpheres, SymmetricSolid_EndsAtTheInsertionLimit) {
  const Sampled s(test::meshOf(test::cuboid({1, 1, 1}, 1)));
  // No sphere fits an edge of a cube: the goal cannot be reached.
  const MedialGoal goal{.minSpheres = 10, .maxStandOff = 0, .maxOutside = 0, .maxInsertions = 200};
  EXPECT_FALSE(approximateMedialAxis(s.solid, s.points, s.spacing, s.sites, goal).inside.empty());
}

}  // namespace
}  // namespace cairn::builder::medial_test
