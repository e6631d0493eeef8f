// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "counterparts/counterpart.h"

namespace cairn::bullet {

/// The directions along which two things may be apart. What finds no room is left out.
class SeparatingNormals {
 public:
  static constexpr std::size_t kMost = 16;

  void clear() { count_ = 0; }
  /// Unit; zero is ignored. `isFace`: of a face of either, not of a line between them.
  void add(const Vec3& normal, bool isFace) {
    if (count_ == kMost || lengthSq(normal) == 0) return;
    normals_[count_] = normal;
    isFace_[count_++] = isFace;
  }
  std::span<const Vec3> all() const { return std::span(normals_).first(count_); }
  bool isFace(std::size_t i) const { return isFace_[i]; }

 private:
  std::array<Vec3, kMost> normals_;
  std::array<bool, kMost> isFace_;
  std::size_t count_ = 0;
};

/// What a moving sphere-tree may run into, in its own frame: elements, of which those of a tree have children.
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
  /// None for what cannot be split.
  virtual Children children(std::uint32_t /*element*/) const { return {}; }
  /// Of a ball around the element; infinite where there is none. Decides what is split.
  virtual float radius(std::uint32_t element) const = 0;
  virtual float margin() const { return 0; }

  /// At which part of the way (0 to 1) the ball comes near the element, at the latest when it touches it; nothing if it
  /// does not. 0 where it is near already.
  virtual std::optional<float> entry(const Sphere& ball, std::uint32_t element, const Vec3& way) const = 0;
  /// The element's point that lies farthest along a unit direction.
  virtual Vec3 support(std::uint32_t element, const Vec3& direction) const = 0;
  /// Directions, away from the element, along which something around `center` may be apart from it.
  virtual void appendNormals(std::uint32_t element, const Vec3& center, SeparatingNormals& normals) = 0;
  /// Writes the part and index of this side.
  virtual void name(std::uint32_t element, ContactId& id) const = 0;
};

std::unique_ptr<SweptTarget> makeSweptTarget(CounterpartKind kind);

}  // namespace cairn::bullet
