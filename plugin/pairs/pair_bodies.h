// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "pairs/body_snapshot.h"
#include "platform/prefetch.h"

namespace cairn::bullet {

/// The order of new pairs within a step; it never depends on an address. `arrival` decides only between children of
/// compounds whose paths have equal digests.
struct PairKey {
  std::uint64_t bodies = 0;
  std::uint64_t children = 0;
  std::size_t arrival = 0;

  friend auto operator<=>(const PairKey&, const PairKey&) = default;
};

/// Copies of both bodies, for an answer that is given before or after Bullet asks.
class PairBodies {
 public:
  /// False when the bodies are nested too deep for a copy.
  bool take(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
    return bodies_[0].take(body0) && bodies_[1].take(body1);
  }

  // Precondition of everything below: `take` succeeded. `follow` and `haveMoved` also need the bodies to live.

  /// Moves the copies to the bodies' present poses; false when their shapes have changed.
  bool follow() { return bodies_[0].follow() && bodies_[1].follow(); }
  /// Whether a body's pose differs from its copy's.
  bool haveMoved() const { return bodies_[0].hasMoved() || bodies_[1].hasMoved(); }
  bool are(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) const {
    return bodies_[0].isOf(body0) && bodies_[1].isOf(body1);
  }
  const btCollisionObjectWrapper& body0() const { return bodies_[0].wrapper(); }
  const btCollisionObjectWrapper& body1() const { return bodies_[1].wrapper(); }
  const btCollisionObject* object0() const { return body0().getCollisionObject(); }
  const btCollisionObject* object1() const { return body1().getCollisionObject(); }
  PairKey key(std::size_t arrival) const;

  /// Prefetches the copies.
  void prefetchData() const {
    for (const BodySnapshot& body : bodies_) prefetch(&body, kCopyBytes);
  }

 private:
  static constexpr std::size_t kCopyBytes = 192;  // most copies need no more of their room

  std::array<BodySnapshot, 2> bodies_;
};

}  // namespace cairn::bullet
