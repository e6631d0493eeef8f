// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "colliders/collider.h"
#include "continuous/separating_normals.h"

namespace cairn::bullet {

/// How far what has no end reaches: farther than anything is that has one. Differences of two such are still numbers.
inline constexpr float kEndless = 1e38F;

/// What a moving sphere-tree may run into: elements, of which those of a tree have children. All lengths and points are
/// in the frame of the target's body, world unit. Nothing here can fail; elements are those taken last.
class SweptTarget {
 public:
  virtual ~SweptTarget() = default;

  /// Takes a shape of the target's kind, and of it what may be near the box [lower, upper].
  virtual void take(const btCollisionShape& shape, const btVector3& lower, const btVector3& upper) = 0;
  /// The elements 0 to `rootCount` - 1 hold everything that was taken.
  virtual std::uint32_t rootCount() const { return 1; }
  struct Children {
    std::uint32_t first = 0, count = 0;
  };
  /// None for what cannot be split, or need not be: what says where its surface is within `crude`, world length.
  virtual Children children(std::uint32_t /*element*/, float /*crude*/) const { return {}; }
  /// Of a ball around the element; infinite where there is none. Decides what is split.
  virtual float radius(std::uint32_t element) const = 0;
  virtual float margin() const { return 0; }

  /// At which part of the way (0 to 1) the ball comes near the element, at the latest when it touches it; nothing if it
  /// does not. 0 where it is near already.
  virtual std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& displacement) const = 0;
  /// The element's point that lies farthest along a unit direction.
  virtual Vec3 support(std::uint32_t element, const Vec3& direction) const = 0;
  /// Directions, away from the element, along which something around `center` may be apart from it.
  virtual void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) = 0;
  /// Writes the part and index of this side, and its element of the pair.
  virtual void name(std::uint32_t element, Contact& contact) const = 0;
};

/// The element's point that lies farthest along a unit direction, both in a frame in which the target's axes are
/// turned.
inline Vec3 supportOf(const SweptTarget& target, std::uint32_t element, const Mat3& axes, const Vec3& direction) {
  return axes * target.support(element, transpose(axes) * direction);
}

/// For shapes that are met as that kind of collider.
std::unique_ptr<SweptTarget> makeSweptTarget(ColliderKind kind);

}  // namespace cairn::bullet
