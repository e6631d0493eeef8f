// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "cairn/core/export.h"

#include "cairn/core/vec3.h"

namespace cairn {

/// A closed ball.
struct Sphere {
  Vec3 center;       ///< in the frame of whoever holds the sphere
  float radius = 0;  ///< in the same unit, >= 0

  friend constexpr bool operator==(const Sphere&, const Sphere&) = default;
};

/// Siblings that one SIMD step tests together; also the largest branching factor.
inline constexpr std::uint32_t kFamilyWidth = 8;

/// Up to eight sibling spheres, structure of arrays: two cache lines answer a whole family. Dead lanes sit at infinity
/// with radius 0, so that no test against a ball of sane size passes there (`SphereTree::livingLanes` is for the
/// others) and no arithmetic on them raises a floating-point exception.
struct alignas(64) Family {
  /// Coordinate of a lane that holds no sphere.
  static constexpr float kNowhere = std::numeric_limits<float>::infinity();

  float x[kFamilyWidth] = {kNowhere, kNowhere, kNowhere, kNowhere,
                           kNowhere, kNowhere, kNowhere, kNowhere};  ///< centres, by lane
  float y[kFamilyWidth] = {kNowhere, kNowhere, kNowhere, kNowhere,
                           kNowhere, kNowhere, kNowhere, kNowhere};  ///< centres, by lane
  float z[kFamilyWidth] = {kNowhere, kNowhere, kNowhere, kNowhere,
                           kNowhere, kNowhere, kNowhere, kNowhere};  ///< centres, by lane
  float radius[kFamilyWidth] = {};                                   ///< by lane; 0 for one that holds no sphere

  /// The sphere of a lane below `kFamilyWidth`.
  Sphere sphere(std::uint32_t lane) const { return {{x[lane], y[lane], z[lane]}, radius[lane]}; }
  /// Puts a sphere into a lane below `kFamilyWidth`.
  void set(std::uint32_t lane, const Sphere& s) {
    x[lane] = s.center.x;
    y[lane] = s.center.y;
    z[lane] = s.center.z;
    radius[lane] = s.radius;
  }
};
static_assert(sizeof(Family) == 128 && std::is_trivially_copyable_v<Family>);

/// Sixteen extreme points of a region, structure of arrays; fewer are repeated.
struct alignas(64) SupportBlock {
  /// Points in a block.
  static constexpr std::uint32_t kWidth = 16;
  float x[kWidth] = {}, y[kWidth] = {}, z[kWidth] = {};  ///< coordinates, by lane; tree frame

  /// The point of a lane below `kWidth`.
  Vec3 point(std::uint32_t lane) const { return {x[lane], y[lane], z[lane]}; }
};
static_assert(sizeof(SupportBlock) == 192 && std::is_trivially_copyable_v<SupportBlock>);

/// Bit i is set when lane i of the family and `s` (same frame and unit) have a point in common, up to rounding: see
/// `kOverlapSlack` for what a caller adds to `s.radius` to be conservative. One step of the fastest instruction set
/// present; the same bits as `overlapScalar` on every one.
CAIRN_CORE_EXPORT
std::uint32_t overlap(const Family& family, const Sphere& s);

/// The scalar twin, for tests and as the definition of the result.
CAIRN_CORE_EXPORT
std::uint32_t overlapScalar(const Family& family, const Sphere& s);

/// The lane whose point is farthest along `direction`; the lowest such lane on a tie.
CAIRN_CORE_EXPORT
std::uint32_t supportLane(const SupportBlock& block, const Vec3& direction);
/// The scalar twin, for tests and as the definition of the result.
CAIRN_CORE_EXPORT
std::uint32_t supportLaneScalar(const SupportBlock& block, const Vec3& direction);

/// Name of the instruction set `overlap` uses on this machine ("AVX2", ...).
CAIRN_CORE_EXPORT
const char* simdTargetName();

/// Relative slack that makes an overlap test conservative, in the lengths involved: moving a centre (three products,
/// three sums a coordinate) and the test itself round by some units of 2^-24 of them, and the transpose of a float
/// matrix is not its inverse, by some nine units for each product of rotations that it comes of (a body's own, and one
/// more for each compound around the tree). 2^-18 are 64 units; searches for the worst found 19 for a body, 57 for a
/// tree four compounds deep, 72 for one that is six deep.
inline constexpr float kOverlapSlack = 1.0F / (1 << 18);

}  // namespace cairn
