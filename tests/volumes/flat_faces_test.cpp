// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/flat_faces.h"

#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "volume_cases.h"

namespace cairn::bench {
namespace {

TEST(FlatFaces, JoinTheTrianglesOfConvexFacesAlone) {
  const builder::TriangleMesh beam = test::solidNamed("I-beam");
  const FlatFaces faces(beam);
  for (std::uint32_t t = 0; t < beam.triangles.size(); ++t) {
    const auto corners = beam.corners(t);
    const Vec3d normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const std::size_t count = faces.around(t).size();
    if (normal.y != 0)  // the ends, shaped like an I
      EXPECT_EQ(count, 1U);
    else if (std::abs(normal.z) > 0 && (corners[0].z == 0 || corners[0].z == 10))  // flanges are three cells wide
      EXPECT_EQ(count, 6U);
    else
      EXPECT_EQ(count, 2U);
  }
}

TEST(FlatFaces, AreTrianglesOnARoundBody) {
  const builder::TriangleMesh mesh = test::lumpyBall(4, test::kVolumeSeed);
  const FlatFaces faces(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    ASSERT_EQ(faces.around(t).size(), 1U);
    EXPECT_EQ(faces.around(t)[0], t);
  }
}

}  // namespace
}  // namespace cairn::bench
