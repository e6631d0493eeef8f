// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/rock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "cairn/builder/import.h"
#include "scenes/figures/random.h"
#include "scenes/truth/exact_check.h"

namespace cairn::scenes::rock_test {
namespace {

constexpr std::uint64_t kSeeds = 25;

TEST(Rock_EverySeed, IsClosedAndManifold) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const builder::TriangleMesh rock = generateRock({seed, 3});
    EXPECT_EQ(rock.triangles.size(), 1280U);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : rock.triangles)
      for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, uses] : edges) {
      EXPECT_EQ(uses, 1) << "seed " << seed;
      EXPECT_TRUE(edges.contains({edge.second, edge.first})) << "seed " << seed;
    }
    const Status status = builder::checkMesh(rock);
    EXPECT_TRUE(status) << "seed " << seed << ": " << status.error().message;
  }
}

TEST(Rock_EverySeed, IsStarShapedHenceFreeOfSelfIntersections) {
  for (std::uint64_t seed = 0; seed < 4 * kSeeds; ++seed) {
    const builder::TriangleMesh rock = generateRock({seed, 3});
    double volume = 0;
    for (std::uint32_t t = 0; t < rock.triangles.size(); ++t) {
      const auto [a, b, c] = rock.corners(t);
      const double part = dot(a, cross(b, c)) / 6;
      EXPECT_GT(part, 0) << "seed " << seed << " triangle " << t;
      volume += part;
    }
    EXPECT_GT(volume, 0.1) << "seed " << seed;
    EXPECT_LT(volume, 0.52) << "seed " << seed;  // of a ball of diameter 1
  }
}

TEST(Rock_EverySeed, IsConcave) {
  // Two of its points whose middle is well outside.
  constexpr double kWellOutside = 0.02;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const builder::TriangleMesh rock = generateRock({seed, 3});
    const auto surface = ExactSurface::create(rock.vertices, rock.triangles);
    ASSERT_TRUE(surface);
    Random random(seed, 99);
    double farthest = 0;
    for (int i = 0; i < 4000 && farthest < kWellOutside; ++i) {
      const auto vertex = [&] { return rock.vertices[random.bits() % rock.vertices.size()]; };
      const Vec3d p = vertex(), q = vertex();
      farthest = std::max(farthest, -surface.value().depth((p + q) * 0.5));
    }
    EXPECT_GE(farthest, kWellOutside) << "seed " << seed;
  }
}

TEST(Rock_SameSeed, GivesTheSameBits) {
  EXPECT_EQ(generateRock({5, 3}).vertices, generateRock({5, 3}).vertices);
  EXPECT_NE(generateRock({5, 3}).vertices, generateRock({6, 3}).vertices);
}

}  // namespace
}  // namespace cairn::scenes::rock_test
