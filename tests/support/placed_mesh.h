// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "builder_meshes.h"
#include "cairn/builder/build.h"

namespace cairn::test {

/// A turn about each axis in turn, then a scale, then a shift that rounds some more.
inline Vec3d placed(Vec3d p, double scale) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  p = {p.x * c - p.y * s, p.x * s + p.y * c, p.z};
  p = {p.x, p.y * c - p.z * s, p.y * s + p.z * c};
  p = {p.x * c - p.z * s, p.y, p.x * s + p.z * c};
  return (p + Vec3d(1, -2, 3)) * scale;
}

/// Any turn and shift of the seed's choice, then the scale.
inline builder::TriangleMesh randomlyPlacedMesh(const builder::TriangleMesh& mesh, std::uint64_t seed, double scale) {
  std::mt19937_64 engine(seed);
  const Mat3d turn = randomRotation(engine);
  const Vec3d shift(uniform(engine, -3, 3), uniform(engine, -3, 3), uniform(engine, -3, 3));
  return moved(mesh, [&](const Vec3d& p) { return (turn * p + shift) * scale; });
}

inline builder::TriangleMesh placedMesh(const builder::TriangleMesh& mesh, double scale) {
  return moved(mesh, [&](const Vec3d& p) { return placed(p, scale); });
}

inline builder::BuildOptions quickAdaptive() {
  builder::BuildOptions options;
  options.method = builder::Method::adaptive;
  options.depth = 2;
  options.branching = 3;  // nine leaves
  return options;
}

/// Balls are the same but for rounding; what is left is where seams end up, and the certificate's own tolerance, a
/// ten-thousandth of the diagonal.
inline constexpr double kCertificate = 1e-4;

/// The adaptive levels of `mesh`, which are those of `as`, are also those of the same mesh placed elsewhere, `scale`
/// times as large.
inline void expectSameLevels(const builder::TriangleMesh& mesh, const SphereTree& as,
                             const builder::TriangleMesh& placed, double scale) {
  const auto there = builder::buildTree(placed, quickAdaptive());
  ASSERT_TRUE(there) << there.error().message;
  const double tolerance = kCertificate * builder::boundsOf(mesh).diagonal();
  for (std::uint32_t level = 1; level <= 2; ++level)
    EXPECT_NEAR(there.value().levelError(level) / scale, as.levelError(level), tolerance) << "level " << level;
}

}  // namespace cairn::test
