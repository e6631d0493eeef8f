// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/fit.h"

#include <gtest/gtest.h>

#include <numbers>

#include "builder_meshes.h"
#include "volume_cases.h"
#include "volumes/hull_2d.h"
#include "volumes/protrusion.h"

namespace cairn::bench {
namespace {

TEST(VolumeFit, HoldsEveryPointOfItsPart) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const builder::TriangleMesh mesh = test::lumpyBall(4, test::kVolumeSeed);
  const builder::SignedDistance solid(mesh);
  const VolumeFit fit(solid);
  std::mt19937_64 engine(test::kVolumeSeed);
  SurfacePart part = builder::piecesOf(mesh);
  int parts = 0;
  for (int axis = 0; part.size() > 2 && parts < 20; axis = (axis + 1) % 3, ++parts) {
    for (const VolumeKind kind : test::kAllKinds) {
      const std::optional<Fit> found = fit(kind, part);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->volume.kind, kind);
      EXPECT_NEAR(dot(found->volume.axes[0], found->volume.axes[1]), 0, 1e-12);
      for (const builder::Piece& piece : part)
        for (int i = 0; i < 5; ++i)
          EXPECT_LE(found->volume.distanceToCore(test::pointOf(piece, engine)), found->volume.radius);
    }
    // Below the middle of the part, across each axis in turn.
    double middle = 0;
    for (const builder::Piece& piece : part) middle += centroidOf(piece)[axis] / static_cast<double>(part.size());
    part = cut(part, {axis, middle})[0];
  }
  EXPECT_GT(parts, 5);
}

/// Certified error of the best fit around the whole solid.
double wholeError(const builder::TriangleMesh& mesh, VolumeKind kind) {
  const builder::SignedDistance solid(mesh);
  const Fit fit = VolumeFit(solid)(kind, builder::piecesOf(mesh)).value();
  return volumeProtrusion(solid, FlatFaces(mesh), fit.volume, builder::defaultProtrusionTolerance(solid)).upper;
}

TEST(VolumeFit, FindsTheObviousVolumes) {
  // At most the radius at the ends, half a diagonal or half a side; and the certificate's tolerance, 1e-4 of 1000 or
  // of 1414, and a hundredth.
  EXPECT_LT(wholeError(test::solidNamed("rod 1000:1"), VolumeKind::capsule), 0.7072 * 1.01 + 0.1);
  EXPECT_LT(wholeError(test::solidNamed("plate 1000:1000:1"), VolumeKind::slab), 0.5 * 1.01 + 0.15);
  // Exactly the plate, but for the tolerance.
  EXPECT_LT(wholeError(test::solidNamed("plate 1000:1000:1"), VolumeKind::box), 0.15);
  // And where a kind cannot fit: a plate's capsule is as thick as half the plate is wide.
  EXPECT_GT(wholeError(test::solidNamed("plate 1000:1000:1"), VolumeKind::capsule), 300);
}

TEST(VolumeFit, DoesNotDependOnHowARodIsTurned) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  std::mt19937_64 engine(test::kVolumeSeed);
  const Mat3d turn = test::randomRotation(engine);
  const builder::TriangleMesh turned =
      test::moved(test::solidNamed("rod 1000:1"), [&](const Vec3d& v) { return turn * v; });
  EXPECT_LT(wholeError(turned, VolumeKind::capsule), 0.7072 * 1.01 + 0.1);
}

TEST(LeastRectangle, IsNoLargerThanAnyOfAThousandDirections) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  std::mt19937_64 engine(test::kVolumeSeed);
  const auto areaAlong = [](const std::vector<Point2>& points, double x, double y) {
    double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
    for (const Point2& p : points) {
      left = std::min(left, p[0] * x + p[1] * y);
      right = std::max(right, p[0] * x + p[1] * y);
      low = std::min(low, p[1] * x - p[0] * y);
      high = std::max(high, p[1] * x - p[0] * y);
    }
    return (right - left) * (high - low);
  };
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Point2> points;
    for (int i = 0; i < 20; ++i) points.push_back({test::uniform(engine), 0.4 * test::uniform(engine)});
    const Point2 best = directionOfLeastRectangle(points);
    const double least = areaAlong(points, best[0], best[1]);
    for (int i = 0; i < 1000; ++i) {
      const double angle = std::numbers::pi * i / 1000;
      EXPECT_LE(least, areaAlong(points, std::cos(angle), std::sin(angle)) * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace cairn::bench
