// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/protrusion.h"

#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "distance_oracle.h"
#include "volume_cases.h"
#include "volumes/random_volumes.h"

namespace cairn::bench {
namespace {

using builder::CertifiedProtrusion;
using builder::ProtrusionTolerance;
using builder::SignedDistance;

class VolumeProtrusion : public testing::TestWithParam<VolumeKind> {};
INSTANTIATE_TEST_SUITE_P(EveryKind, VolumeProtrusion, testing::ValuesIn(test::kAllKinds));

/// Distance outside the solid, by the slow judge.
double outside(const test::DistanceOracle& oracle, const Vec3d& point) {
  return std::max(0.0, -oracle.depth(point));
}

TEST_P(VolumeProtrusion, IsAboveEverySampleAndAttainedAtItsWitness) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const builder::TriangleMesh mesh = test::lumpyBall(3, test::kVolumeSeed);
  const test::DistanceOracle oracle{mesh};
  const SignedDistance solid(mesh);
  const ProtrusionTolerance tolerance = builder::defaultProtrusionTolerance(solid);
  std::mt19937_64 engine(test::kVolumeSeed);
  for (int i = 0; i < 12; ++i) {
    const SweptBall volume = randomVolume(GetParam(), engine);
    const CertifiedProtrusion proved = volumeProtrusion(solid, FlatFaces(mesh), volume, tolerance);
    double sampled = 0;
    for (int s = 0; s < 300; ++s) sampled = std::max(sampled, outside(oracle, test::pointOf(volume, engine)));
    EXPECT_LE(sampled, proved.upper);
    EXPECT_LE(volume.distanceToCore(proved.witness), volume.radius * (1 + 1e-12));
    EXPECT_GE(outside(oracle, proved.witness) * (1 + 1e-12), proved.lower);
    // What the tolerance allows, and twice the guard on either side.
    EXPECT_LE(proved.upper, proved.lower * 1.01 + tolerance.absolute * 1.01);
  }
}

TEST(VolumeProtrusionOfBalls, AgreesWithTheBuilder) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  const builder::TriangleMesh mesh = test::lumpyBall(4, test::kVolumeSeed);
  const SignedDistance solid(mesh);
  const ProtrusionTolerance tolerance = builder::defaultProtrusionTolerance(solid);
  std::mt19937_64 engine(test::kVolumeSeed);
  for (int i = 0; i < 200; ++i) {
    const SweptBall ball = randomVolume(VolumeKind::ball, engine);
    const CertifiedProtrusion ours = volumeProtrusion(solid, FlatFaces(mesh), ball, tolerance);
    const CertifiedProtrusion theirs = builder::certifiedProtrusion(solid, ball.center, ball.radius, tolerance);
    EXPECT_LE(ours.lower, theirs.upper);
    EXPECT_LE(theirs.lower, ours.upper);
  }
}

TEST(VolumeProtrusionOfSweptBalls, IsWhatGeometrySays) {
  const builder::TriangleMesh mesh = test::meshOf(test::cuboid({10, 6, 2}, 1));
  const SignedDistance solid(mesh);
  const ProtrusionTolerance tolerance = builder::defaultProtrusionTolerance(solid);
  const auto expectError = [&](const SweptBall& volume, double expected) {
    const CertifiedProtrusion proved = volumeProtrusion(solid, FlatFaces(mesh), volume, tolerance);
    EXPECT_LE(proved.lower, expected);
    EXPECT_GE(proved.upper, expected);
    EXPECT_LE(proved.upper, expected * 1.01 + tolerance.absolute * 1.01);
  };
  const std::array<Vec3d, 3> axes{Vec3d{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  // Flush with top and bottom, half a unit out at the sides.
  expectError({VolumeKind::slab, {}, axes, {4.5, 2.5, 0}, 1}, 0.5);
  expectError({VolumeKind::slab, {}, axes, {3, 1, 0}, 0.5}, 0);
  // The solid itself; and a box that is farthest out at its corners.
  expectError({VolumeKind::box, {}, axes, {5, 3, 1}, 0}, 0);
  expectError({VolumeKind::box, {}, axes, {5.3, 3.4, 1}, 0}, 0.5);
  // Above and below by half, in the direction of the axis by one and a half.
  expectError({VolumeKind::capsule, {}, axes, {5, 0, 0}, 1.5}, 1.5);
  expectError({VolumeKind::capsule, {}, axes, {3, 0, 0}, 1.5}, 0.5);
}

}  // namespace
}  // namespace cairn::bench
