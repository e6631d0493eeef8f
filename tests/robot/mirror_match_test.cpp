// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/mirror_match.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "builder_meshes.h"

namespace cairn::builder::mirror_match_test {
namespace {

/// Another exporter's order of vertices and triangles.
TriangleMesh shuffled(const TriangleMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::uint32_t> order(mesh.vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), engine);
  TriangleMesh result = mesh;
  for (std::uint32_t i = 0; i < order.size(); ++i) result.vertices[order[i]] = mesh.vertices[i];
  for (Triangle& t : result.triangles) {
    for (std::uint32_t& v : t) v = order[v];
    std::rotate(t.begin(), t.begin() + engine() % 3, t.end());
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), engine);
  return result;
}

TEST(MirrorMatch, FindsEverySignAndOrder) {
  const TriangleMesh lump = test::lumpyBall(3, 5);
  for (unsigned minus = 0; minus < 8; ++minus) {
    const Vec3d signs{minus & 1 ? -1.0 : 1.0, minus & 2 ? -1.0 : 1.0, minus & 4 ? -1.0 : 1.0};
    const auto match = mirrorMatch(shuffled(mirrored(lump, signs), minus + 1), lump);
    ASSERT_TRUE(match) << minus;
    EXPECT_EQ(match->signs, signs);
    EXPECT_EQ(match->deviation, 0);
  }
}

TEST(MirrorMatch, TellsWhatAnExporterRounded) {
  const TriangleMesh lump = test::lumpyBall(3, 5);
  TriangleMesh rounded = mirrored(lump, {1, -1, 1});
  double worst = 0;
  for (Vec3d& v : rounded.vertices) {
    const Vec3d before = v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(v[axis] * 1e6) / 1e6;
    worst = std::max(worst, distance(before, v));
  }
  const auto match = mirrorMatch(rounded, lump);
  ASSERT_TRUE(match);
  EXPECT_GT(worst, 0);
  EXPECT_EQ(match->deviation, worst);
}

TEST(MirrorMatch, RefusesWhatDiffers) {
  const TriangleMesh lump = test::lumpyBall(3, 5);
  EXPECT_FALSE(mirrorMatch(test::lumpyBall(3, 6), lump));
  EXPECT_FALSE(mirrorMatch(test::flipped(lump), lump));  // the same points, inside out
  TriangleMesh dented = lump;
  dented.vertices[7] *= 0.999;
  EXPECT_FALSE(mirrorMatch(dented, lump));
  EXPECT_FALSE(mirrorMatch(test::moved(lump, [](const Vec3d& v) { return v + Vec3d{0.01, 0, 0}; }), lump));
  EXPECT_FALSE(mirrorMatch(test::moved(lump, [](const Vec3d& v) { return v * 1.001; }), lump));
}

}  // namespace
}  // namespace cairn::builder::mirror_match_test
