// SPDX-License-Identifier: GPL-3.0-or-later
// A solid cut along its tree: nothing is lost, nothing is covered twice, and what touched is bonded.
#include "cairn/builder/fracture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "built_trees.h"
#include "cairn/builder/certify.h"
#include "cairn/builder/import.h"
#include "fracture/bonds.h"
#include "fracture/cut.h"
#include "surface/mass_properties.h"
#include "surface/signed_distance.h"

namespace cairn::test::fracture_test {
namespace {

using builder::Fracture;
using builder::TriangleMesh;

struct Named {
  const char* name;
  TriangleMesh mesh;
};

std::vector<Named> solids() {
  return {{"ball", meshOf(ball(1, 3))},
          {"lumpy ball", lumpyBall(3, 5)},
          {"box", meshOf(cuboid({1, 2, 3}, 3))},
          {"torus", torus(1, 0.3, 24, 12)},
          {"cylinder", cylinder(0.5, 2, 24)}};
}

Fracture broken(const TriangleMesh& mesh, const SphereTree& tree) {
  auto fracture = builder::fracture(mesh, tree);
  EXPECT_TRUE(fracture) << fracture.error().message;
  return fracture ? std::move(fracture).value() : Fracture{};
}

// Of first moments and inertia, relative to the whole's size: those of volumes, times a lever.
constexpr double kTolerance = 1e-8;

TEST(Fracture, KeepsVolumeCentreAndInertia) {
  for (const Named& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const Fracture fracture = broken(solid.mesh, quickTree(solid.mesh));
    ASSERT_GE(fracture.pieces.size(), 2U);
    const MassProperties whole = massPropertiesOf(solid.mesh);
    double volume = 0;
    Vec3d moment{0, 0, 0};
    Mat3d inertia;
    for (Vec3d& row : inertia.rows) row = {0, 0, 0};
    for (const TriangleMesh& piece : fracture.pieces) {
      const MassProperties part = massPropertiesOf(piece);
      EXPECT_GT(part.volume, 0);
      volume += part.volume;
      moment = moment + part.centerOfMass * part.volume;
      const Vec3d d = part.centerOfMass - whole.centerOfMass;
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
          inertia(row, column) +=
              part.volume * (part.inertia(row, column) + (row == column ? dot(d, d) : 0) - d[row] * d[column]);
    }
    EXPECT_NEAR(volume / whole.volume, 1, builder::kMaxVolumeError);
    EXPECT_LT(length(moment * (1 / volume) - whole.centerOfMass), kTolerance * boundsOf(solid.mesh).diagonal());
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        EXPECT_NEAR(inertia(row, column) / volume, whole.inertia(row, column),
                    kTolerance * std::pow(boundsOf(solid.mesh).diagonal(), 2));
    std::printf("%s: %zu pieces, %zu bonds, volume error %.1e\n", solid.name, fracture.pieces.size(),
                fracture.bonds.size(), fracture.volumeError);
  }
}

// Points at random, seed printed: each lies in the piece of the branch whose power distance is least, and in no other.
TEST(Fracture, EachPointIsInOnePieceThatOfTheNearestBranch) {
  constexpr std::uint64_t kSeed = 11;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  for (const Named& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const SphereTree tree = quickTree(solid.mesh);
    const Fracture fracture = broken(solid.mesh, tree);
    const builder::SignedDistance whole(solid.mesh);
    std::vector<builder::SignedDistance> pieces;
    for (const TriangleMesh& piece : fracture.pieces) pieces.emplace_back(piece);
    const builder::Bounds bounds = boundsOf(solid.mesh);
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> unit(0, 1);
    const double tolerance = 1e-9 * bounds.diagonal();
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d size = bounds.upper - bounds.lower;
      const Vec3d p = bounds.lower + Vec3d{unit(random) * size.x, unit(random) * size.y, unit(random) * size.z};
      int holders = 0;
      bool isNearACut = std::abs(whole.query(p).depth) < tolerance;
      for (const builder::SignedDistance& piece : pieces) {
        const double depth = piece.query(p).depth;
        isNearACut = isNearACut || std::abs(depth) < tolerance;
        if (depth > 0) ++holders;
      }
      if (isNearACut) continue;
      const bool isInside = whole.query(p).depth > 0;
      EXPECT_EQ(holders, isInside ? 1 : 0);
      inside += isInside ? 1 : 0;
    }
    EXPECT_GT(inside, 200);
  }
}

TEST(Fracture, PiecesTreesCertify) {
  const TriangleMesh mesh = lumpyBall(3, 5);
  for (const TriangleMesh& piece : broken(mesh, quickTree(mesh)).pieces) {
    const SphereTree tree = quickTree(piece);
    const auto proof = builder::certify(tree, piece);
    ASSERT_TRUE(proof) << proof.error().message;
    EXPECT_EQ(proof.value().failures(tree), std::vector<std::string>{});
  }
}

// The cut of a box across its middle by two equal balls.
TEST(Fracture, ABoxCutAcrossHasBondsOfItsSection) {
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 3}, 2));
  const Fracture fracture = broken(mesh, quickTree(mesh));
  // The section of a convex solid: from each side the same, so bonds are symmetric and all hang together.
  std::vector<std::size_t> group(fracture.pieces.size());
  std::iota(group.begin(), group.end(), 0U);
  for (const builder::Bond& bond : fracture.bonds) {
    EXPECT_LT(bond.first, bond.second);
    EXPECT_GT(bond.area, 0);
    const std::size_t from = group[bond.second], to = group[bond.first];
    std::ranges::replace(group, from, to);
  }
  for (const std::size_t g : group) EXPECT_EQ(g, group.front());
}

TEST(CommonArea, IsThatOfOverlappingFaces) {
  const builder::HalfSpace middle{{1, 0, 0}, 0.25};
  const TriangleMesh whole = meshOf(cuboid({1, 1, 1}, 2));
  auto behind = builder::cut(whole, std::vector{middle});
  auto before = builder::cut(whole, std::vector{builder::HalfSpace{{-1, 0, 0}, -0.25}});
  ASSERT_TRUE(behind && before);
  ASSERT_EQ(behind.value().size(), 1U);
  ASSERT_EQ(before.value().size(), 1U);
  const double side = boundsOf(whole).upper.y - boundsOf(whole).lower.y;
  EXPECT_NEAR(commonArea(behind.value()[0], before.value()[0], middle, 1e-9), side * side, 1e-9);
  TriangleMesh aside = before.value()[0];
  for (Vec3d& v : aside.vertices) v.y += side / 4;
  EXPECT_NEAR(commonArea(behind.value()[0], aside, middle, 1e-9), side * side * 3 / 4, 1e-9);
}

// A torus halved through its axis falls into two parts on each side.
TEST(Cut, GivesEachPartThatHangsTogether) {
  const auto parts = builder::cut(torus(1, 0.3, 24, 12),
                                  std::vector{builder::HalfSpace{{1, 0, 0}, 0.1}, builder::HalfSpace{{-1, 0, 0}, 0.1}});
  ASSERT_TRUE(parts);
  EXPECT_EQ(parts.value().size(), 2U);
  const auto none = builder::cut(torus(1, 0.3, 24, 12), std::vector{builder::HalfSpace{{1, 0, 0}, -9}});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none.value().empty());
}

TEST(Fracture, RefusesAMeshThatIsNoSolidAndCanBeCancelled) {
  const TriangleMesh mesh = lumpyBall(2, 1);
  const SphereTree tree = quickTree(mesh);
  TriangleMesh open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(builder::fracture(open, tree));
  const auto cancelled = builder::fracture(mesh, tree, [](auto&&...) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().message, builder::kCancelled);
}

TEST(Fracture, SameBitsTwice) {
  const TriangleMesh mesh = lumpyBall(3, 2);
  const SphereTree tree = quickTree(mesh);
  const Fracture a = broken(mesh, tree), b = broken(mesh, tree);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  EXPECT_EQ(a.bonds, b.bonds);
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    EXPECT_EQ(a.pieces[i].vertices, b.pieces[i].vertices);
    EXPECT_EQ(a.pieces[i].triangles, b.pieces[i].triangles);
  }
}

}  // namespace
}  // namespace cairn::test::fracture_test
