// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <LinearMath/btTransform.h>

#include <array>
#include <cstdint>
#include <optional>

namespace cairn::bullet {

/// A copy of the wrapper that Bullet hands to an algorithm. Bullet's wrappers live on the stack of the dispatch, but
/// collected pairs are answered after it.
class BodySnapshot {
 public:
  /// Wrapper levels: a shape in a compound in a compound.
  static constexpr std::size_t kMaxNesting = 3;

  BodySnapshot() = default;
  BodySnapshot(const BodySnapshot&) = delete;
  BodySnapshot& operator=(const BodySnapshot&) = delete;

  /// Copies the wrapper. False, and no copy, when compounds are nested deeper than `kMaxNesting`.
  bool take(const btCollisionObjectWrapper& wrapper);
  /// Moves the copy to its body's present pose, compound children included. False, and no copy, when the shapes have
  /// changed. Precondition: `take` succeeded and the object lives.
  bool follow();
  /// Whether the object's pose differs from the copy's. Precondition: as for `follow`.
  bool hasMoved() const;
  /// Whether the copy equals `wrapper`. Precondition: `take` succeeded.
  bool isOf(const btCollisionObjectWrapper& wrapper) const;
  /// Precondition: `take` succeeded.
  const btCollisionObjectWrapper& wrapper() const { return *levels_[depth_ - 1].wrapper; }

 private:
  struct Level {
    btTransform transform;
    std::optional<btCollisionObjectWrapper> wrapper;  // refers to `transform`
  };
  std::size_t depth_ = 0;
  std::array<Level, kMaxNesting> levels_;  // outermost first
};

/// Digest of the child indices from a body down to a wrapper's shape; 0 for a body that is no compound.
std::uint32_t childPath(const btCollisionObjectWrapper& wrapper);

}  // namespace cairn::bullet
