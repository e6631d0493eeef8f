// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/simplify.h"

#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

double volumeOf(const TriangleMesh& mesh) {
  return massPropertiesOf(mesh).volume;
}

TEST(Simplify, KeepsTheSolidClosedAndItsVolume) {
  const TriangleMesh fine = test::lumpyBall(20, 7);
  const Result<TriangleMesh> coarse = simplify(fine, 500);
  ASSERT_TRUE(coarse.ok()) << coarse.error().message;
  EXPECT_LE(coarse.value().triangles.size(), 500U);
  EXPECT_GE(coarse.value().triangles.size(), 490U) << "no further than asked";
  EXPECT_TRUE(checkMesh(coarse.value()).ok());
  // The placement of Lindstrom and Turk preserves volume at every collapse.
  EXPECT_NEAR(volumeOf(coarse.value()), volumeOf(fine), 0.01 * volumeOf(fine));
}

TEST(Simplify, MeshThatIsCoarseEnough_StaysAsItIs) {
  const TriangleMesh mesh = test::lumpyBall(2, 1);
  const Result<TriangleMesh> same = simplify(mesh, 1U << 20);
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same.value().triangles, mesh.triangles);
  EXPECT_EQ(same.value().vertices, mesh.vertices);
}

TEST(Simplify, SameBitsTwice) {
  const TriangleMesh mesh = test::lumpyBall(12, 5);
  EXPECT_EQ(objText(simplify(mesh, 300).value()), objText(simplify(mesh, 300).value()));
}

TEST(Simplify, TooFewTriangles_IsNamed) {
  const Result<TriangleMesh> none = simplify(test::torus(1, 0.3, 24, 12), 4);  // no torus has four triangles
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("ask for more"), std::string::npos) << none.error().message;
}

}  // namespace
}  // namespace cairn::builder
