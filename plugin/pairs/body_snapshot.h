// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <LinearMath/btTransform.h>

#include <array>
#include <cstdint>
#include <optional>

namespace cairn::bullet {

/// A copy of what Bullet hands to an algorithm about a body. Its wrappers live on the stack of the dispatch (those of
/// compound children with their transforms), and the answer to a collected pair is given after that.
class BodySnapshot {
 public:
  /// A shape, in a compound, in a compound.
  static constexpr std::size_t kMaxNesting = 3;

  BodySnapshot() = default;
  BodySnapshot(const BodySnapshot&) = delete;
  BodySnapshot& operator=(const BodySnapshot&) = delete;

  /// False when compounds are nested deeper than `kMaxNesting`; then there is no copy.
  bool take(const btCollisionObjectWrapper& wrapper);
  /// Takes the copy to where its body is now: the object's pose, and those of the compounds' children in it. False
  /// when the shapes are not those copied; then there is no copy. Precondition: `take` succeeded, the object lives.
  bool follow();
  /// Whether the object has another pose than the copy. Precondition: as for `follow`.
  bool hasMoved() const;
  /// Whether the copy says what `wrapper` says. Precondition: `take` succeeded.
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

/// Digest of the child indices on the way to a wrapper's shape; 0 for a body that is no compound.
std::uint32_t childPath(const btCollisionObjectWrapper& wrapper);

}  // namespace cairn::bullet
