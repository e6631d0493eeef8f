// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "import/self_intersection.h"
#include "surface/mass_properties.h"

namespace cairn::builder::check_mesh_test {
namespace {

using test::cuboid;
using test::meshOf;

void expectRefused(const TriangleMesh& mesh, const std::string& part) {
  const Status status = checkMesh(mesh);
  ASSERT_FALSE(status.ok()) << "expected: " << part;
  EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
  EXPECT_EQ(status.error().message.find('\n'), std::string::npos);
}

TEST(CheckMesh, AcceptsClosedSolids) {
  EXPECT_TRUE(checkMesh(meshOf(cuboid({1, 2, 3}, 3))).ok());
  EXPECT_TRUE(checkMesh(test::torus(1, 0.3, 16, 8)).ok());
  EXPECT_TRUE(checkMesh(test::lumpyBall(8, 1)).ok());
  EXPECT_TRUE(checkMesh(meshOf(test::twoCuboids({1, 1, 1}, {2, 0, 0}, 2))).ok());
}

TEST(CheckMesh, RefusesWhatNumbersCannotHold) {
  const auto placed = [](double scale, double away) {
    TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
    for (Vec3d& v : mesh.vertices) v = v * scale + Vec3d(1, 0, 0) * away;
    return mesh;
  };
  for (const double scale : {1e-15, 1e-6, 1.0, 1e6, 1e13}) EXPECT_TRUE(checkMesh(placed(scale, 0)).ok()) << scale;
  expectRefused(placed(1e15, 0), "give it in another unit");
  expectRefused(placed(1e30, 0), "give it in another unit");
  expectRefused(placed(1e-17, 0), "give it in another unit");
  expectRefused(placed(1e-40, 0), "give it in another unit");
  EXPECT_TRUE(checkMesh(placed(1, 1e9)).ok());
  const auto rod = [](double times) {
    TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
    for (Vec3d& v : mesh.vertices) v.x *= times;
    return mesh;
  };
  EXPECT_TRUE(checkMesh(rod(1e6)).ok());
  expectRefused(rod(1e12), "too long for its thickness");
}

TEST(CheckMesh, AcceptsNestedShellsThatFaceAwayFromTheSolid) {
  const auto box = [](double size) { return meshOf(cuboid({size, size, size}, 2)); };
  const TriangleMesh hollow = test::joined(box(3), test::flipped(box(2)));
  EXPECT_TRUE(checkMesh(hollow).ok()) << checkMesh(hollow).error().message;
  EXPECT_TRUE(checkMesh(test::joined(hollow, box(1))).ok());  // a stone in the cavity
}

// The shared corner is the cavity's first: where it lies says nothing about the rest.
TEST(CheckMesh, AcceptsACavityThatSharesACornerWithTheOutside) {
  TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 2));
  const auto x = static_cast<std::uint32_t>(mesh.vertices.size()), y = x + 1, z = x + 2;
  const auto corner = static_cast<std::uint32_t>(
      std::ranges::max_element(mesh.vertices, {}, [](const Vec3d& v) { return v.x + v.y + v.z; }) -
      mesh.vertices.begin());
  for (const Vec3d& v : {Vec3d{0.1, 0, 0}, Vec3d{0, 0.1, 0}, Vec3d{0, 0, 0.1}}) mesh.vertices.push_back(v);
  // Facing into the tetrahedron.
  for (const Triangle& t : {Triangle{corner, x, z}, Triangle{corner, z, y}, Triangle{corner, y, x}, Triangle{x, y, z}})
    mesh.triangles.push_back(t);
  EXPECT_TRUE(checkMesh(mesh).ok()) << checkMesh(mesh).error().message;
}

TEST(CheckMesh, AcceptsAPinchedVertex) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  EXPECT_TRUE(checkMesh(mesh).ok()) << checkMesh(mesh).error().message;
}

TEST(CheckMesh, RefusesBadElements) {
  expectRefused({}, "there are no triangles");
  TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  mesh.vertices[3].y = std::nan("");
  expectRefused(mesh, "vertex 3 is not finite");
  mesh = meshOf(cuboid({1, 1, 1}, 1));
  mesh.triangles[5][1] = 8;
  expectRefused(mesh, "triangle 5 names vertex 8 of 8");
  mesh = meshOf(cuboid({1, 1, 1}, 1));
  mesh.triangles[4][1] = mesh.triangles[4][0];
  expectRefused(mesh, "triangle 4 at ");
}

TEST(CheckMesh, RefusesAHoleAndNamesTheEdge) {
  TriangleMesh mesh = meshOf(cuboid({2, 2, 2}, 1));
  mesh.triangles.pop_back();
  expectRefused(mesh, "the mesh is open: the edge (1, ");
}

TEST(CheckMesh, RefusesAnEdgeOfFourTriangles) {
  // Two cubes that share one edge.
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  const TriangleMesh other = test::moved(cube, [](const Vec3d& v) { return v + Vec3d{1, 1, 0}; });
  TriangleMesh mesh = cube;
  for (std::uint32_t t = 0; t < other.triangles.size(); ++t) {
    Triangle triangle{};
    for (int i = 0; i < 3; ++i) {
      const Vec3d p = other.corners(t)[i];
      auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
      if (found == mesh.vertices.end()) found = mesh.vertices.insert(found, p);
      triangle[i] = static_cast<std::uint32_t>(found - mesh.vertices.begin());
    }
    mesh.triangles.push_back(triangle);
  }
  expectRefused(mesh, "belongs to 4 triangles");
}

TEST(CheckMesh, RefusesInconsistentOrientation) {
  TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  expectRefused(mesh, "face opposite sides at their common edge");
}

TEST(CheckMesh, RefusesAnInsideOutMesh) {
  expectRefused(test::flipped(test::lumpyBall(3, 1)), "inside out");
}

TEST(CheckMesh, RefusesAFlatMesh) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  expectRefused(mesh, "flat");
}

TEST(CheckMesh, AcceptsANeedle) {
  const TriangleMesh needle = meshOf(cuboid({1e4, 1e-3, 1e-3}, 1));
  EXPECT_TRUE(checkMesh(needle).ok()) << checkMesh(needle).error().message;
}

TEST(CheckMesh, RefusesAFlatMeshAtAnAngle) {
  TriangleMesh mesh;
  mesh.vertices = {{0.1, 0.2, 0.3}, {1.7, 0.1, 0.9}, {0.3, 1.1, 2.3}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  expectRefused(mesh, "flat");
}

TEST(CheckMesh, AdvisesOnlyWhatExists) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  const auto aside = [](const Vec3d& v) { return v + Vec3d{0.5, 0.5, 0.5}; };
  const Status status = checkMesh(test::joined(cube, test::moved(cube, aside)));
  ASSERT_FALSE(status.ok());
  EXPECT_TRUE(status.error().message.ends_with("intersect; repair the mesh")) << status.error().message;
}

TEST(CheckMesh, RefusesSelfIntersection) {
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  expectRefused(test::joined(cube, test::moved(cube,
                                               [](const Vec3d& v) {
                                                 return v + Vec3d{0.5, 0.5, 0.5};
                                               })),
                "intersect");
  // Touching face to face, with no common vertex, is refused too: which side is inside is undecided there.
  expectRefused(test::joined(cube, test::moved(cube,
                                               [](const Vec3d& v) {
                                                 return v + Vec3d{1, 0.25, 0.25};
                                               })),
                "intersect");
  TriangleMesh spike = meshOf(cuboid({1, 1, 1}, 3));
  spike.vertices[0] = spike.vertices[0] * -3.0;
  expectRefused(spike, "intersect");
}

TEST(CheckMesh, RefusesShellsThatFaceTheWrongWay) {
  const auto box = [](double size) { return meshOf(cuboid({size, size, size}, 2)); };
  expectRefused(test::joined(box(3), box(2)), "faces outward inside another one");
  const TriangleMesh aside = test::moved(box(1), [](const Vec3d& v) { return v + Vec3d{5, 0, 0}; });
  expectRefused(test::joined(box(3), test::flipped(aside)), "faces inward but is no cavity");
}

TEST(SelfIntersection, NamesTheLowestPairOfABruteForceSearch) {
  // Random soups of single triangles: no shared vertices, so the plain test of two triangles decides. The oracle
  // samples edges against triangles in long double; pairs too close to call are left out by the generator.
  std::mt19937_64 engine(5);
  int found = 0;
  for (int round = 0; round < 200; ++round) {
    TriangleMesh mesh;
    for (std::uint32_t t = 0; t < 12; ++t) {
      const Vec3d center = test::randomPoint(engine) * 2.0;
      for (int i = 0; i < 3; ++i) mesh.vertices.push_back(center + test::randomPoint(engine));
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const auto edgeHits = [&](std::uint32_t a, std::uint32_t b) {
      const auto p = mesh.corners(a), q = mesh.corners(b);
      const Vec3d n = cross(q[1] - q[0], q[2] - q[0]);
      for (int i = 0; i < 3; ++i) {
        const Vec3d from = p[i], to = p[(i + 1) % 3];
        const double d0 = dot(from - q[0], n), d1 = dot(to - q[0], n);
        if ((d0 > 0) == (d1 > 0)) continue;
        const Vec3d x = from + (to - from) * (d0 / (d0 - d1));
        bool inside = true;
        for (int j = 0; j < 3; ++j) inside &= dot(cross(q[(j + 1) % 3] - q[j], x - q[j]), n) >= 0;
        if (inside) return true;
      }
      return false;
    };
    std::optional<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::uint32_t a = 0; a < 12 && !expected; ++a) {
      for (std::uint32_t b = a + 1; b < 12 && !expected; ++b) {
        if (edgeHits(a, b) || edgeHits(b, a)) expected = {a, b};
      }
    }
    EXPECT_EQ(findSelfIntersection(mesh), expected) << "seed 5, round " << round;
    found += expected.has_value();
  }
  EXPECT_GT(found, 20);
  EXPECT_LT(found, 200);
}

}  // namespace
}  // namespace cairn::builder::check_mesh_test
