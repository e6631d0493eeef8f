// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "cairn/core/vec3.h"

namespace cairn::builder {

/// The feature of a triangle that holds its point nearest to a query. Edge i runs from corner i to corner i + 1.
enum class Feature : std::uint8_t { corner0, corner1, corner2, edge0, edge1, edge2, face };

/// Up to four triangles as a structure of arrays, each in an orthonormal frame of its own plane. Corner A is the
/// frame's origin, B lies at (lengthAB, 0), and C at lengthAC * ac, above AB.
///
/// The frame makes the distance backward stable, also for slivers. The computed value is the exact distance to a
/// triangle with slightly moved corners. They move by a few units in the last place of (edge length + distance).
/// Barycentric coordinates would lose half of the digits of a sliver.
struct alignas(64) TrianglePacket {
  static constexpr int kWidth = 4;

  double originX[kWidth], originY[kWidth], originZ[kWidth];
  double uX[kWidth], uY[kWidth], uZ[kWidth];  ///< unit, along AB
  double vX[kWidth], vY[kWidth], vZ[kWidth];  ///< unit, in the plane, towards C
  double lengthAB[kWidth];
  double acX[kWidth], acY[kWidth], lengthAC[kWidth];  ///< unit direction in the plane, and length
  double bcX[kWidth], bcY[kWidth], lengthBC[kWidth];
  std::uint32_t triangle[kWidth];

  void set(int lane, std::uint32_t index, const std::array<Vec3d, 3>& corners);

  /// The vector from the nearest point of one triangle to `query`, and the feature of that point.
  struct Nearest {
    Vec3d offset;
    Feature feature = Feature::face;
  };
  Nearest nearest(int lane, const Vec3d& query) const;
};

}  // namespace cairn::builder
