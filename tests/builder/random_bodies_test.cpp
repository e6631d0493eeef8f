// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes of random closed bodies: apart, overlapping, touching, in each other, hollow, copied, inside out, in any order
// and any unit. Repair makes each scene the union of its bodies, judged by the winding numbers of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/repair.h"
#include "distance_oracle.h"
#include "test_solids.h"

namespace cairn::builder::random_bodies_test {
namespace {

/// Nearer to a surface than this fraction of the size, repair may move it: faces that nearly coincide by one and a half
/// times the weld, at needles by at most eight times as much.
constexpr double kMoved = 8 * 1.5 * RepairOptions().weld;

struct HollowBody {
  TriangleMesh outside;
  std::vector<TriangleMesh> hollow;  ///< none or one
};

Vec3d somePoint(std::mt19937_64& engine, double reach) {
  return {test::uniform(engine, -reach, reach), test::uniform(engine, -reach, reach),
          test::uniform(engine, -reach, reach)};
}

/// On a lattice of halves, where faces, edges and corners of cuboids coincide.
Vec3d halves(std::mt19937_64& engine, int least, int most) {
  const auto one = [&] { return 0.5 * (least + static_cast<int>(engine() % (most - least + 1))); };
  const double x = one(), y = one();
  return {x, y, one()};
}

TriangleMesh someShape(std::mt19937_64& engine) {
  switch (engine() % 5) {
    case 0:
      return test::meshOf(test::cuboid(halves(engine, 1, 4), 1));
    case 1:
      return test::meshOf(test::cuboid(somePoint(engine, 0.5) + Vec3d{1, 1, 1}, 1));
    case 2:
      return test::meshOf(test::ball(0.7, 1 + static_cast<int>(engine() % 2)));
    case 3:
      return test::cylinder(0.6, 1.2, 3 + engine() % 6);
    default:
      return test::torus(0.8, 0.3, 12, 8);
  }
}

/// Around an axis through the origin (Rodrigues' formula).
Vec3d turned(const Vec3d& v, const Vec3d& axis, double angle) {
  return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
}

HollowBody someBody(std::mt19937_64& engine, bool onLattice) {
  const TriangleMesh shape = someShape(engine);
  const Vec3d axis = normalized(somePoint(engine, 1) + Vec3d{0, 0, 1.5});
  const double angle = onLattice ? 0 : test::uniform(engine, 0, 3),
               size = onLattice ? 1 : test::uniform(engine, 0.3, 1.3);
  const Vec3d at = onLattice ? halves(engine, -2, 2) : somePoint(engine, 1);
  const auto place = [&](double part) {
    return test::moved(shape, [&](const Vec3d& v) { return turned(v * (part * size), axis, angle) + at; });
  };
  HollowBody body{place(1), {}};
  const bool holdsItsMiddle = test::DistanceOracle{shape}.windingNumber({}) > 0.9;
  if (holdsItsMiddle && engine() % 4 == 0) body.hollow.push_back(place(0.5));
  return body;
}

std::vector<HollowBody> someScene(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const bool onLattice = seed % 2 == 0;
  std::vector<HollowBody> scene;
  for (std::uint64_t left = 1 + engine() % 7; left > 0; --left) scene.push_back(someBody(engine, onLattice));
  return scene;
}

/// All triangles in a random order; now and then a body is there twice, or all is inside out.
TriangleMesh meshOf(const std::vector<HollowBody>& scene, std::uint64_t seed) {
  TriangleMesh mesh;
  for (const HollowBody& body : scene) {
    mesh = test::joined(mesh, body.outside);
    for (const TriangleMesh& hollow : body.hollow) mesh = test::joined(mesh, test::flipped(hollow));
  }
  if (seed % 5 == 0 && scene[0].hollow.empty()) mesh = test::joined(mesh, scene[0].outside);
  std::mt19937_64 engine(seed);
  for (std::size_t t = mesh.triangles.size(); t > 1; --t)
    std::swap(mesh.triangles[t - 1], mesh.triangles[engine() % t]);
  return seed % 7 == 0 ? test::flipped(mesh) : mesh;
}

/// Points on the other side of the repaired surface than the bodies say, and how many were in the solid.
struct Judged {
  int wrong = 0, inSolid = 0;
};

Judged judged(const std::vector<HollowBody>& scene, const TriangleMesh& mesh, const TriangleMesh& solid,
              std::uint64_t seed) {
  const auto isWithin = [](const TriangleMesh& closed, const Vec3d& p) {
    return test::DistanceOracle{closed}.windingNumber(p) > 0.5;
  };
  const test::DistanceOracle source{mesh}, after{solid};
  const Bounds bounds = boundsOf(mesh);
  std::mt19937_64 engine(seed);
  Judged result;
  for (int i = 0; i < 400; ++i) {
    Vec3d p = bounds.center();
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += test::uniform(engine, -0.55, 0.55) * (bounds.upper[axis] - bounds.lower[axis]);
    if (source.distance(p) < kMoved * bounds.diagonal()) continue;
    const bool isIn = std::ranges::any_of(scene, [&](const HollowBody& body) {
      return isWithin(body.outside, p) && (body.hollow.empty() || !isWithin(body.hollow[0], p));
    });
    result.inSolid += isIn;
    result.wrong += isIn != (after.windingNumber(p) > 0.5);
  }
  return result;
}

TEST(RandomBodies, BecomeTheUnionThatTheirWindingNumbersSay) {
  int inSolid = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const std::vector<HollowBody> scene = someScene(seed);
    const TriangleMesh mesh = meshOf(scene, seed);
    const double unit = std::array{1.0, 1e-3, 1e3}[seed % 3];
    const auto scaled = [&](double by) { return [by](const Vec3d& v) { return v * by; }; };
    RepairCounts counts;
    const Result<TriangleMesh> solid = repair(test::moved(mesh, scaled(unit)), &counts);
    ASSERT_TRUE(solid.ok()) << solid.error().message;
    EXPECT_TRUE(checkMesh(solid.value()).ok());
    const Judged result = judged(scene, mesh, test::moved(solid.value(), scaled(1 / unit)), seed);
    EXPECT_EQ(result.wrong, 0) << counts.text();
    inSolid += result.inSolid;
  }
  EXPECT_GT(inSolid, 3000);
}

}  // namespace
}  // namespace cairn::builder::random_bodies_test
