// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "surface/mass_properties.h"

namespace cairn::builder::simplify_test {
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

TEST(Simplify, StopsWhenToldTo) {
  const TriangleMesh mesh = test::lumpyBall(40, 5);
  int calls = 0;
  double last = 0;
  const auto count = [&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++calls;
    return true;
  };
  ASSERT_TRUE(simplify(mesh, 100, count).ok());
  EXPECT_GT(calls, 3);
  for (const int allowed : {0, 1, calls - 1}) {
    int asked = 0;
    const auto cancel = [&](std::string_view, double) { return asked++ < allowed; };
    const Result<TriangleMesh> result = simplify(mesh, 100, cancel);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, kCancelled);
    EXPECT_EQ(asked, allowed + 1);
  }
}

TEST(Simplify, ResultThatIntersectsItself_IsOneSentence) {
  // A box in a box: fewer triangles than both have can only be had by cutting one of them open into the other.
  const TriangleMesh outer = test::meshOf(test::cuboid({1, 1, 1}, 1)),
                     inner = test::flipped(test::meshOf(test::cuboid({0.9, 0.9, 0.9}, 1)));
  const Result<TriangleMesh> none = simplify(test::joined(outer, inner), 12);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(std::count(none.error().message.begin(), none.error().message.end(), ';'), 1) << none.error().message;
  EXPECT_NE(none.error().message.find("12 triangles"), std::string::npos) << none.error().message;
}

}  // namespace
}  // namespace cairn::builder::simplify_test
