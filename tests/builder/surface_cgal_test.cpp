// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL as a second, independent opinion; alone in its file because of what it costs to compile.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "builder_meshes.h"
#include "surface/signed_distance.h"

namespace cairn::builder::surface_cgal_test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

Surface surfaceOf(const TriangleMesh& mesh) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Vec3d& v : mesh.vertices) vertices.push_back(surface.add_vertex({v.x, v.y, v.z}));
  for (const Triangle& t : mesh.triangles) surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return surface;
}

void expectSameAsCgal(const TriangleMesh& mesh) {
  constexpr std::uint64_t kSeed = 77;
  const Surface surface = surfaceOf(mesh);
  const Tree tree(faces(surface).begin(), faces(surface).end(), surface);
  const CGAL::Side_of_triangle_mesh<Surface, Kernel> side(tree);
  const SignedDistance solid(mesh);
  std::mt19937_64 engine(kSeed);
  for (int i = 0; i < 3000; ++i) {
    const Vec3d q = test::randomPoint(engine) * (i % 10 == 0 ? 30.0 : 1.5);
    const Kernel::Point_3 p(q.x, q.y, q.z);
    const double depth = solid.depth(q);
    // CGAL constructs in doubles too, with barycentric formulas; 1e-12 of lengths near 30 is far above both roundings.
    ASSERT_NEAR(std::abs(depth), std::sqrt(tree.squared_distance(p)), 1e-11) << "seed " << kSeed;
    ASSERT_EQ(depth > 0, side(p) == CGAL::ON_BOUNDED_SIDE) << "seed " << kSeed;
  }
}

TEST(SignedDistance, AgreesWithCgalOnAConcaveBody) {
  expectSameAsCgal(test::lumpyBall(10, 4));
}
TEST(SignedDistance, AgreesWithCgalOnATorus) {
  expectSameAsCgal(test::torus(1, 0.35, 32, 16));
}
TEST(SignedDistance, AgreesWithCgalOnACube) {
  expectSameAsCgal(test::meshOf(test::cuboid({1, 1, 1}, 1)));
}

}  // namespace
}  // namespace cairn::builder::surface_cgal_test
