// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/flat_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace cairn::builder::flat_patch_test {
namespace {

constexpr std::uint64_t kSeed = 5;
constexpr double kTolerance = 1e-6;

Vec3d areaOf(const std::vector<Vec3d>& polygon) {
  Vec3d area;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    area += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]) * 0.5;
  return area;
}

// Every other corner further in, turned out of every plane of the axes.
std::vector<Vec3d> star(std::mt19937_64& engine, std::size_t corners) {
  std::uniform_real_distribution<double> radius(0.2, 2);
  const Vec3d u = normalized(Vec3d(1, 2, 3)), v = normalized(cross(u, Vec3d(0.3, -1, 0.2)));
  std::vector<Vec3d> polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    polygon.push_back(Vec3d(5, -3, 7) + (u * std::cos(angle) + v * std::sin(angle)) * radius(engine));
  }
  return polygon;
}

TEST(FlatPatch, CoversThePolygonOnce_TurningAsItDoes) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 engine(kSeed);
  for (std::size_t corners = 3; corners < 200; ++corners) {
    const std::vector<Vec3d> polygon = star(engine, corners);
    const Patch patch = flatPatch(polygon, kTolerance);
    ASSERT_EQ(patch.size(), corners - 2);
    const Vec3d whole = areaOf(polygon);
    Vec3d sum;
    for (const auto& [a, b, c] : patch) {
      const Vec3d part = areaOf({polygon[std::size_t(a)], polygon[std::size_t(b)], polygon[std::size_t(c)]});
      EXPECT_GT(dot(part, whole), 0);
      sum += part;
    }
    EXPECT_NEAR(length(sum - whole), 0, 1e-12 * length(whole));
  }
}

TEST(FlatPatch, IsEmpty_WhereThePolygonIsNone) {
  const Vec3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), xy(1, 1, 0), z(0, 0, 1);
  EXPECT_TRUE(flatPatch(std::vector{o, x, x * 2, x * 3, x * 4}, kTolerance).empty()) << "a line";
  EXPECT_TRUE(flatPatch(std::vector{o, o, o, o}, kTolerance).empty()) << "a point";
  EXPECT_TRUE(flatPatch(std::vector{o, xy, x, y * 2}, kTolerance).empty()) << "crosses itself";
  EXPECT_TRUE(flatPatch(std::vector{o, x, y, o, z, x}, 10).empty()) << "touches itself";
  EXPECT_TRUE(flatPatch(std::vector{o, x, xy + z * 0.1, y}, kTolerance).empty()) << "bends";
  EXPECT_EQ(flatPatch(std::vector{o, x, xy + z * 0.1, y}, 0.1).size(), 2U) << "bends no more than allowed";
}

}  // namespace
}  // namespace cairn::builder::flat_patch_test
