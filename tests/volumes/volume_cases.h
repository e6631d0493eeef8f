// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <random>

#include "random_tree.h"
#include "volumes/solids.h"
#include "volumes/surface_part.h"
#include "volumes/swept_ball.h"

namespace cairn::test {

inline constexpr std::uint64_t kVolumeSeed = 20;
inline constexpr std::array kAllKinds{bench::VolumeKind::ball, bench::VolumeKind::capsule, bench::VolumeKind::slab,
                                      bench::VolumeKind::box};

/// The generated solid of this name.
inline builder::TriangleMesh solidNamed(const std::string& name) {
  for (bench::NamedMesh& named : bench::generatedSolids())
    if (named.name == name) return std::move(named.mesh);
  return {};
}

/// A point of the volume: half of them on its surface.
inline Vec3d pointOf(const bench::SweptBall& volume, std::mt19937_64& engine) {
  Vec3d core = volume.center;
  for (int i = 0; i < volume.dimensions(); ++i) core += volume.axes[i] * (volume.half[i] * uniform(engine, -1, 1));
  const double away = uniform(engine) < 0.5 ? 1 : std::cbrt(uniform(engine));
  return core + randomRotation(engine).column(0) * (away * volume.radius);
}

inline Vec3d pointOf(const builder::Piece& piece, std::mt19937_64& engine) {
  double s = uniform(engine), t = uniform(engine);
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return piece.corners[0] + (piece.corners[1] - piece.corners[0]) * s + (piece.corners[2] - piece.corners[0]) * t;
}

inline double areaOf(const bench::SurfacePart& part) {
  double area = 0;
  for (const builder::Piece& piece : part) area += builder::areaOf(piece);
  return area;
}

}  // namespace cairn::test
