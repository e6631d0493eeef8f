// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <optional>

#include "colliders/collider.h"
#include "continuous/separating_normals.h"

namespace cairn::bullet {

/// The extent of infinite elements: larger than that of any finite one. Differences of two such lengths stay finite.
inline constexpr float kInfiniteExtent = 1e38F;

/// A shape that a moving sphere-tree may meet, as elements; elements of a tree have children. All lengths and points
/// are in the frame of the target's body, world unit. Nothing here can fail; elements are those taken last.
///
///     SweptPlane target;
///     target.take(shape, lower, upper);
///     for (std::uint32_t i = 0; i < target.rootCount(); ++i) ...;
class SweptTarget {
 public:
  virtual ~SweptTarget() = default;

  /// Takes a shape of the target's kind, limited to parts near the box [lower, upper].
  virtual void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) = 0;
  /// The elements 0 to `rootCount` - 1 hold everything that was taken.
  virtual std::uint32_t rootCount() const { return 1; }
  struct Children {
    std::uint32_t first = 0, count = 0;
  };
  /// Empty for an element that cannot be split, or need not be: its surface is known within `crude`, a world length.
  virtual Children children(std::uint32_t /*element*/, float /*crude*/) const { return {}; }
  /// Radius of a ball around the element, infinite where there is none. It decides what is split.
  virtual float radius(std::uint32_t element) const = 0;
  /// The margin that grows all elements, world length.
  virtual float margin() const { return 0; }

  /// The fraction (0 to 1) of its displacement at which the ball comes near the element, at the latest when they touch.
  /// Empty if it does not; 0 if it is near already.
  virtual std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const = 0;
  /// The element's point that lies farthest along a unit direction.
  virtual Vec3 support(std::uint32_t element, const Vec3& direction) const = 0;
  /// Appends directions, away from the element, along which a region around `center` may be apart from it.
  virtual void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) = 0;
  /// Writes this side's part and index, and its element of the pair.
  virtual void name(std::uint32_t element, Contact& contact) const = 0;
};

/// The element's point that lies farthest along a unit direction, both in a frame with these axes of the target.
inline Vec3 supportOf(const SweptTarget& target, std::uint32_t element, const Mat3& axes, const Vec3& direction) {
  return axes * target.support(element, transpose(axes) * direction);
}

}  // namespace cairn::bullet
