// SPDX-License-Identifier: GPL-3.0-or-later
// Trees grown region by region in the body's own frame do not depend on how the mesh lies, and are brought back whole.
#include "hierarchy/grow_in_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/certify.h"
#include "hierarchy/cut_again.h"
#include "placed_mesh.h"
#include "regions/method_traits.h"
#include "regions/split_region.h"

namespace cairn::builder::grow_in_body_test {
namespace {

std::vector<Method> methodsGrownInTheBody() {
  std::vector<Method> methods;
  for (const MethodTraits& traits : allMethods())
    if (traits.frame == GrownIn::body) methods.push_back(traits.method);
  return methods;
}

class GrownInBody : public testing::TestWithParam<Method> {
 protected:
  static Result<SphereTree> built(const TriangleMesh& mesh) {
    BuildOptions options;
    options.method = GetParam();
    options.depth = 2;
    options.samples = 600;
    return buildTree(mesh, options);
  }
};
INSTANTIATE_TEST_SUITE_P(Build, GrownInBody, testing::ValuesIn(methodsGrownInTheBody()), [](const auto& method) {
  std::string name = methodName(method.param);
  std::erase(name, '-');
  return name;
});

/// Two certificates of the same ball: each is at most 1 % and 1e-4 of its mesh's diagonal above the truth
/// (`defaultProtrusionTolerance`), `diagonal` being the larger one. A millionth of it more for the ball, whose centre
/// and radius are rounded to float in each mesh's own axes.
double certificatesDiffer(double error, double diagonal) {
  return 0.01 * error + (1e-4 + 1e-6) * diagonal;
}

void expectSameShape(const SphereTree& a, const SphereTree& b) {
  ASSERT_EQ(a.data().nodes.size(), b.data().nodes.size());
  for (std::size_t i = 0; i < a.data().nodes.size(); ++i) {
    ASSERT_EQ(a.data().nodes[i].parent, b.data().nodes[i].parent) << "node " << i;
    ASSERT_EQ(a.data().nodes[i].triangleCount, b.data().nodes[i].triangleCount) << "node " << i;
  }
}

/// Turned, moved and scaled at once: the same nodes over the same triangles, with the same errors.
TEST_P(GrownInBody, TreeIsTheSameHoweverTheMeshLies) {
  for (const auto& mesh : {test::lumpyBall(1, 5), test::cylinder(0.3, 2, 12)}) {
    const Result<SphereTree> as = built(mesh);
    ASSERT_TRUE(as);
    std::uint64_t seed = 0;
    for (const double scale : {1.0, 1e-6, 1e6}) {
      SCOPED_TRACE("seed " + std::to_string(++seed) + ", scale " + std::to_string(scale));
      const TriangleMesh placed = test::randomlyPlacedMesh(mesh, seed, scale);
      const Result<SphereTree> there = built(placed);
      ASSERT_TRUE(there) << there.error().message;
      expectSameShape(as.value(), there.value());
      const double diagonal = std::max(boundsOf(mesh).diagonal(), boundsOf(placed).diagonal() / scale);
      for (std::uint32_t level = 0; level <= 2; ++level) {
        const double error = as.value().levelError(level);
        EXPECT_NEAR(there.value().levelError(level) / scale, error, certificatesDiffer(error, diagonal))
            << "level " << level;
      }
      const Result<Certificate> certificate = certify(there.value(), placed);
      ASSERT_TRUE(certificate);
      EXPECT_EQ(certificate.value().failures(there.value()), std::vector<std::string>{});
    }
  }
}

TEST(GrowInBody, GivesNothingWhenCancelled) {
  EXPECT_TRUE(growInBody(test::lumpyBall(1, 1), [](const SignedDistance&) { return RegionTree(); }).empty());
}

/// Most cuts that lead to a piece here. Each rounds the three coordinates of a middle by half a unit in the last place:
/// 2^-54 each in the mesh, which the shear makes at most 2.5 times as long, and 2^-52 in the image, whose coordinates
/// are below 4. Together less than 2^-50.
constexpr int kMaxCuts = 40;
constexpr double kCutRounding = kMaxCuts * 0x1p-50;

/// A shear makes other edges the longest, so a cut that looked at the lengths in the other mesh would go elsewhere.
TEST(CutAgain, PiecesOfAnAffineImageAreTheImagesOfThePieces) {
  const auto sheared = [](const Vec3d& p) { return Vec3d(p.x + 2 * p.y, 0.125 * p.y + p.z, 0.5 * p.z - p.x); };
  const TriangleMesh mesh = test::lumpyBall(1, 4), image = test::moved(mesh, sheared);
  const SignedDistance solid(mesh);
  const SplitSettings settings{Method::combined, 4, 1, 1e-6};
  const RegionTree from = growRegionTree(rootRegion(solid, 500), 2, solid, settings, [](auto...) { return true; });
  RegionTree tree = from;
  cutAgain(tree, mesh, image);
  std::size_t cut = 0;
  for (std::size_t n = 0; n < tree.size(); ++n) {
    const Pieces &before = from[n].region.pieces, &after = tree[n].region.pieces;
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      ASSERT_EQ(after[i].source, before[i].source);
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_LE(distance(after[i].corners[c], sheared(before[i].corners[c])), kCutRounding);
      if (!(after[i].corners == image.corners(after[i].source))) ++cut;
    }
  }
  EXPECT_GT(cut, 1000U) << "most pieces are parts of triangles";
}

}  // namespace
}  // namespace cairn::builder::grow_in_body_test
