// SPDX-License-Identifier: GPL-3.0-or-later
// Prisms over polygons of all kinds, written as polygons: what is read must be their solid.
#include "import/triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "placed_mesh.h"
#include "run_program.h"
#include "surface/mass_properties.h"

namespace cairn::builder::triangulate_test {
namespace {

using Outline = std::vector<std::pair<double, double>>;  // counter-clockwise

double areaOf(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto& [x, y] = outline[i];
    const auto& [u, v] = outline[(i + 1) % outline.size()];
    sum += (x * v - y * u) / 2;
  }
  return sum;
}

/// An OFF file of the prism of height one over `outline`, turned and moved: two polygons, and a quadrangle at each edge
/// but the doubled ones of a bridge.
std::string prismText(const Outline& outline) {
  const std::size_t n = outline.size();
  std::ostringstream points, faces;
  points.precision(17);
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : outline) {
      const Vec3d p = test::placed({x, y, z}, 1);
      points << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
  }
  const auto at = [&](std::size_t i) { return outline[i % n]; };
  const auto isBridge = [&](std::size_t i) {
    for (std::size_t k = 0; k < n; ++k)
      if (at(k) == at(i + 1) && at(k + 1) == at(i)) return true;
    return false;
  };
  faces << "# bottom, top, sides\n" << n;
  for (std::size_t i = 0; i < n; ++i) faces << ' ' << n - 1 - i;
  faces << '\n' << n;
  for (std::size_t i = 0; i < n; ++i) faces << ' ' << n + i;
  faces << '\n';
  std::size_t count = 2;
  for (std::size_t i = 0; i < n; ++i) {
    if (isBridge(i) || at(i) == at(i + 1)) continue;
    const std::size_t j = (i + 1) % n;
    faces << "4 " << i << ' ' << j << ' ' << n + j << ' ' << n + i << '\n';
    ++count;
  }
  return "OFF\n" + std::to_string(2 * n) + ' ' + std::to_string(count) + " 0\n" + points.str() + faces.str();
}

/// `importMesh` proves that the surface is closed and meets itself nowhere.
void expectPrism(const Outline& outline) {
  const test::TemporaryFolder folder;
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "prism.off", prismText(outline)));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_NEAR(massPropertiesOf(read.value()).volume, areaOf(outline), 1e-12 * read.value().triangles.size());
}

TEST(Triangulated, ConcaveAndFlatQuadrangles_WhereverTheDentIs) {
  const Outline arrow{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}}, triangle{{0, 0}, {1, 0}, {2, 0}, {1, 1.5}};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    for (Outline outline : {arrow, triangle}) {
      SCOPED_TRACE(turn);
      std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(turn), outline.end());
      expectPrism(outline);
    }
  }
}

TEST(Triangulated, CornersOnStraightSides_StayCorners) {
  expectPrism({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}});
}

TEST(Triangulated, AHoleReachedByABridge_StaysOpen) {
  expectPrism({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST(Triangulated, RepeatedCorners_AreOne) {
  expectPrism({{0, 0}, {0, 0}, {2, 0}, {2, 2}, {2, 2}, {2, 2}, {1, 3}, {0, 2}, {0, 0}});
}

TEST(Triangulated, StarsOfAnyShape) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto corners = static_cast<int>(test::uniform(random, 5, 60));
    Outline star;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, radius = test::uniform(random, 0.1, 1);
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    expectPrism(star);
  }
}

TEST(Triangulated, ACombOfManyCorners) {
  Outline comb;
  for (int tooth = 0; tooth < 200; ++tooth) {
    comb.emplace_back(tooth, 0);
    comb.emplace_back(tooth + 0.5, 5 + tooth % 3);
  }
  comb.emplace_back(200, 0);
  comb.emplace_back(200, 10);
  comb.emplace_back(0, 10);
  expectPrism(comb);
}

PolygonSoup onePolygon(std::vector<Vec3d> points) {
  PolygonSoup soup{std::move(points), {}, {}};
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) soup.corners.push_back(i);
  soup.endPolygon();
  return soup;
}

// At heights that are no binary fractions, where a plane through the corners is off by rounding.
TEST(Triangulated, ACombFlatInOneAxis) {
  Outline comb;
  for (int tooth = 0; tooth < 30; ++tooth) {
    const double from = 4 * tooth / 10.0, to = (4 * tooth + 2) / 10.0, next = (4 * tooth + 4) / 10.0;
    comb.insert(comb.end(), {{from, 0.0}, {to, 0.0}, {to, -1.0}, {next, -1.0}});
  }
  comb.insert(comb.end(), {{12.0, 1.0}, {0.0, 1.0}});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double height : {0.0, 0.1, 0.3, 0.7}) {
      std::vector<Vec3d> corners(comb.size());
      for (std::size_t i = 0; i < comb.size(); ++i) {
        corners[i][axis] = height;
        corners[i][(axis + 1) % 3] = comb[i].first;
        corners[i][(axis + 2) % 3] = comb[i].second;
      }
      const TriangleSoup soup = triangulated(onePolygon(corners));
      double area = 0;  // of a fan's triangles, turned over in places, more than the polygon's
      for (const auto& t : soup) area += length(cross(t[1] - t[0], t[2] - t[0])) / 2;
      EXPECT_EQ(soup.size(), comb.size() - 2);
      EXPECT_NEAR(area, areaOf(comb), 1e-12 * areaOf(comb)) << "axis " << axis << " at " << height;
    }
  }
}

TEST(Triangulated, WhatHasNoTriangulation_StillEndsAsTriangles) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{2, 0, 0}, d{0, 1, 0}, e{1, 1, 0};
  EXPECT_EQ(triangulated(onePolygon({a, a, a, a, a})).size(), 1U);
  EXPECT_EQ(triangulated(onePolygon({a, b, a, b, a, b})).size(), 4U);  // there and back
  EXPECT_EQ(triangulated(onePolygon({a, b, c, b, a, c})).size(), 4U);
  EXPECT_EQ(triangulated(onePolygon({a, e, b, d, c})).size(), 3U);  // crosses itself
  std::vector<Vec3d> knot;
  for (int i = 0; i < 501; ++i) knot.push_back({std::cos(i * 2.4), std::sin(i * 2.4), std::sin(i * 7.0)});
  EXPECT_EQ(triangulated(onePolygon(knot)).size(), 499U);
}

}  // namespace
}  // namespace cairn::builder::triangulate_test
