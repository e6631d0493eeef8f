// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "read_back.h"
#include "surface/mass_properties.h"

namespace cairn::builder::repair_test {
namespace {

using test::cuboid;
using test::meshOf;

/// Volumes of meshes whose corners were rounded to float, a relative 2^-24 each.
constexpr double kFloatVolume = 1e-6;

TriangleMesh box(double size, int cells = 2) {
  return meshOf(cuboid({size, size, size}, cells));
}

/// The repaired mesh; fails the test when there is none.
TriangleMesh repaired(const TriangleMesh& mesh, RepairCounts& counts) {
  const Result<TriangleMesh> result = repair(mesh, &counts);
  EXPECT_TRUE(result.ok()) << result.error().message;
  if (!result) return box(1);
  EXPECT_TRUE(checkMesh(result.value()).ok());
  return result.value();
}

void expectRefused(const TriangleMesh& mesh, const std::string& part) {
  const Result<TriangleMesh> result = repair(mesh);
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
}

/// Every triangle with corners of its own, each moved by at most `amount` along every axis.
TriangleMesh torn(const TriangleMesh& mesh, double amount, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  TriangleMesh result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Vec3d& c : mesh.corners(t)) result.vertices.push_back(c + test::randomPoint(engine) * amount);
    result.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return result;
}

TEST(Repair, LeavesAGoodMeshAsItIs) {
  const TriangleMesh mesh = test::lumpyBall(6, 2);
  RepairCounts counts;
  const TriangleMesh same = repaired(mesh, counts);
  EXPECT_FALSE(counts.any());
  EXPECT_EQ(counts.text(), "nothing");
  ASSERT_EQ(same.triangles.size(), mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto sum = [](const TriangleMesh& m, std::uint32_t i) {
      const auto c = m.corners(i);
      return Vec3(c[0]) + Vec3(c[1]) + Vec3(c[2]);
    };
    EXPECT_LT(length(Vec3d(sum(same, t)) - Vec3d(sum(mesh, t))), 1e-6) << "triangle " << t;  // the same, in order
  }
}

TEST(Repair, ClosesAnOpenBox) {
  TriangleMesh open = box(2);
  open.triangles.resize(open.triangles.size() - 8);  // one side of 2 x 2 squares
  ASSERT_NE(checkMesh(open).error().message.find("open"), std::string::npos);
  RepairCounts counts;
  const TriangleMesh closed = repaired(open, counts);
  EXPECT_EQ(counts.filledHoles, 1U);
  EXPECT_EQ(counts.addedTriangles, 6U);  // a polygon of eight edges
  EXPECT_EQ(counts.turnedTriangles, 0U);
  EXPECT_EQ(counts.text(), "1 hole filled, 6 triangles added");
  EXPECT_NEAR(signedVolume(closed), 8, 8 * kFloatVolume);
}

TEST(Repair, FillsHolesThatMeetInAVertexOneByOne) {
  const TriangleMesh whole = test::lumpyBall(4, 3);
  TriangleMesh holed = whole;
  const Triangle first = whole.triangles[0];
  const auto touches = [&](const Triangle& t) {
    return std::count_if(t.begin(), t.end(),
                         [&](std::uint32_t v) { return std::find(first.begin(), first.end(), v) != first.end(); });
  };
  const auto second =
      std::find_if(whole.triangles.begin(), whole.triangles.end(), [&](const Triangle& t) { return touches(t) == 1; });
  ASSERT_NE(second, whole.triangles.end());
  holed.triangles.erase(holed.triangles.begin() + (second - whole.triangles.begin()));
  holed.triangles.erase(holed.triangles.begin());
  RepairCounts counts;
  const TriangleMesh filled = repaired(holed, counts);
  EXPECT_EQ(counts.filledHoles, 2U);
  EXPECT_EQ(counts.addedTriangles, 2U);
  EXPECT_NEAR(signedVolume(filled), signedVolume(whole), signedVolume(whole) * kFloatVolume);
}

TEST(Repair, TurnsWhatFacesTheWrongWay) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::mt19937_64 engine(seed);
    const TriangleMesh mesh = test::lumpyBall(5, seed);
    TriangleMesh twisted = mesh;
    std::size_t turned = 0;
    for (Triangle& t : twisted.triangles) {
      if (engine() % 3 != 0) continue;
      std::swap(t[0], t[1]);
      ++turned;
    }
    ASSERT_GT(turned, 0U);
    ASSERT_FALSE(checkMesh(twisted).ok());
    RepairCounts counts;
    const TriangleMesh straight = repaired(twisted, counts);
    EXPECT_EQ(counts.turnedTriangles, turned) << "seed " << seed;
    EXPECT_NEAR(signedVolume(straight), signedVolume(mesh), signedVolume(mesh) * kFloatVolume) << "seed " << seed;
  }
}

TEST(Repair, TurnsAMeshInsideOut) {
  RepairCounts counts;
  const TriangleMesh mesh = repaired(test::flipped(box(1)), counts);
  EXPECT_EQ(counts.turnedTriangles, mesh.triangles.size());
  EXPECT_NEAR(signedVolume(mesh), 1, kFloatVolume);
}

TEST(Repair, DropsDuplicatesWhicheverWayTheyFace) {
  TriangleMesh mesh = box(1);
  const Triangle a = mesh.triangles[3], b = mesh.triangles[5];
  mesh.triangles.push_back({a[1], a[2], a[0]});
  mesh.triangles.push_back({b[1], b[0], b[2]});
  ASSERT_FALSE(checkMesh(mesh).ok());
  RepairCounts counts;
  const TriangleMesh result = repaired(mesh, counts);
  EXPECT_EQ(counts.duplicateTriangles, 2U);
  EXPECT_EQ(result.triangles.size(), mesh.triangles.size() - 2);
  EXPECT_NEAR(signedVolume(result), 1, kFloatVolume);
}

TEST(Repair, StitchesCracks) {
  const TriangleMesh mesh = test::lumpyBall(5, 4);
  const double tolerance = kStitchTolerance * boundsOf(mesh).diagonal();
  // Two copies of a corner are less than the tolerance apart when each moved by a quarter along every axis.
  const TriangleMesh cracked = torn(mesh, tolerance / 4, 9);
  RepairCounts counts;
  const TriangleMesh result = repaired(cracked, counts);
  EXPECT_GT(counts.joinedVertices, cracked.vertices.size() / 2);
  EXPECT_EQ(counts.filledHoles, 0U);
  EXPECT_EQ(result.vertices.size(), mesh.vertices.size());
  EXPECT_NEAR(signedVolume(result), signedVolume(mesh), signedVolume(mesh) * 1e-5);  // every face moved by 1e-6
}

TEST(Repair, ClosesTJunctions) {
  // A square of one side has a corner in the middle of its edge that the neighbouring side does not have.
  TriangleMesh mesh = box(2, 1);
  const Triangle whole = mesh.triangles[0];
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back((mesh.vertices[whole[0]] + mesh.vertices[whole[1]]) * 0.5);
  mesh.triangles[0] = {whole[0], middle, whole[2]};
  mesh.triangles.push_back({middle, whole[1], whole[2]});
  ASSERT_NE(checkMesh(mesh).error().message.find("open"), std::string::npos);
  RepairCounts counts;
  const TriangleMesh result = repaired(mesh, counts);
  EXPECT_EQ(counts.splitTriangles, 1U);
  EXPECT_EQ(counts.filledHoles, 0U);
  EXPECT_EQ(result.triangles.size(), 14U);
  EXPECT_NEAR(signedVolume(result), 8, 8 * kFloatVolume);
}

// What a shell inside another one is, the ways they face tell: a hollow, or a second body.
TEST(Repair, KeepsACavityHoweverTheMeshIsTurned) {
  for (const bool isInsideOut : {false, true}) {
    TriangleMesh hollow = test::joined(box(3), test::flipped(box(2)));
    if (isInsideOut) hollow = test::flipped(hollow);
    RepairCounts counts;
    const TriangleMesh result = repaired(hollow, counts);
    EXPECT_EQ(counts.turnedTriangles, isInsideOut ? hollow.triangles.size() : 0);
    EXPECT_NEAR(signedVolume(result), 27 - 8, 27 * kFloatVolume);
  }
}

TEST(Repair, FindsTheCavityAmongTurnedTriangles) {
  TriangleMesh hollow = test::joined(box(3), test::flipped(box(2)));
  std::size_t turned = 0;
  for (std::size_t t = 0; t < hollow.triangles.size(); t += 3, ++turned)
    std::swap(hollow.triangles[t][0], hollow.triangles[t][1]);
  RepairCounts counts;
  EXPECT_NEAR(signedVolume(repaired(hollow, counts)), 27 - 8, 27 * kFloatVolume);
  EXPECT_EQ(counts.turnedTriangles, turned);
}

TEST(Repair, LeavesOutABodyInsideAnother) {
  RepairCounts counts;
  const TriangleMesh result = repaired(test::joined(box(3), box(2)), counts);
  EXPECT_EQ(counts.enclosedBodies, 1U);
  EXPECT_EQ(counts.turnedTriangles, 0U);
  EXPECT_NEAR(signedVolume(result), 27, 27 * kFloatVolume);
}

TEST(Repair, ABodyInAHollowStays) {
  RepairCounts counts;
  const TriangleMesh nested = test::joined(test::joined(box(3), test::flipped(box(2))), box(1));
  EXPECT_NEAR(signedVolume(repaired(nested, counts)), 27 - 8 + 1, 27 * kFloatVolume);
  EXPECT_FALSE(counts.any()) << counts.text();
}

TEST(Repair, GivesTheMeshItsFileHolds) {
  TriangleMesh open = test::lumpyBall(6, 8);
  open.triangles.erase(open.triangles.begin() + 7);
  RepairCounts counts;
  const TriangleMesh mesh = repaired(open, counts);
  EXPECT_EQ(mesh.name, "test, repaired");
  test::expectReadBack(mesh);
}

TEST(Repair, RandomDamageEndsAsASolidOrASentence) {
  int solids = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 engine(seed);
    TriangleMesh mesh = test::lumpyBall(4, seed);
    std::erase_if(mesh.triangles, [&](const Triangle&) { return engine() % 12 == 0; });
    for (Triangle& t : mesh.triangles)
      if (engine() % 12 == 0) std::swap(t[0], t[2]);
    for (std::size_t i = 0; i < 5; ++i) mesh.triangles.push_back(mesh.triangles[engine() % mesh.triangles.size()]);
    const Result<TriangleMesh> result = repair(mesh);
    if (!result) {
      EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << "seed " << seed;
      continue;
    }
    ++solids;
    EXPECT_TRUE(checkMesh(result.value()).ok()) << "seed " << seed;
    // Only triangles are added: every vertex was one of the source's.
    for (const Vec3d& v : result.value().vertices) {
      EXPECT_TRUE(
          std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3d& w) { return Vec3d(Vec3(w)) == v; }))
          << "seed " << seed;
    }
  }
  EXPECT_GT(solids, 50);
}

TEST(Repair, NamesWhatItCannotMend) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  sheet.name = "sheet";
  expectRefused(sheet, "sheet: after repair");
  expectRefused(sheet, "the sheet at (0, 0, 0) encloses nothing");
  const TriangleMesh above = test::moved(sheet, [](const Vec3d& v) { return v + Vec3d{-0.5, -0.5, 0.25}; });
  expectRefused(test::joined(box(1), above), "the sheet at (-0.5, -0.5, 0.25) encloses nothing");
  TriangleMesh fin = box(1, 1);  // a third triangle at an edge
  fin.vertices.push_back({2, 2, 2});
  fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], 8});
  expectRefused(fin, "test: after repair");
}

TEST(Repair, RefusesAMoebiusStrip) {
  TriangleMesh strip;
  constexpr std::uint32_t kSteps = 30;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps, half = angle / 2;
    for (const double side : {-0.3, 0.3}) {
      const double ring = 1 + side * std::cos(half);
      strip.vertices.push_back({ring * std::cos(angle), ring * std::sin(angle), side * std::sin(half)});
    }
    const bool last = i + 1 == kSteps;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, b, d});
    strip.triangles.push_back({a, d, c});
  }
  expectRefused(strip, "after repair");
}

// Repaired meshes are rounded to float: far from its origin less and less of one is left.
TEST(RepairOf, FarFromTheOriginEndsAsASolidOrIsRefused) {
  for (const double away : {1e6, 1e7, 3e7, 1e8, 1e9, 1e12, 1e18}) {
    TriangleMesh mesh = box(2);
    for (Vec3d& v : mesh.vertices) v = v + Vec3d(1, 1, 1) * away;
    SCOPED_TRACE(away);
    const Result<TriangleMesh> result = repair(mesh);
    if (result)
      EXPECT_TRUE(checkMesh(result.value()).ok());
    else
      EXPECT_NE(result.error().message.find("mesh"), std::string::npos);
    if (away >= 1e9) {
      ASSERT_FALSE(result);
      EXPECT_NE(result.error().message.find("nearer to its origin"), std::string::npos) << result.error().message;
    }
  }
}

}  // namespace
}  // namespace cairn::builder::repair_test
