// SPDX-License-Identifier: Zlib
#pragma once

#include <unordered_map>

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// What is known of the objects of a world. Looked up, never walked through, so the order of a hash table decides
/// nothing.
class SideBook {
 public:
  void enter(const btCollisionObject& object, const Traits& traits) { entries_[&object] = {nullptr, traits}; }
  /// `body` must stay where it is.
  void enter(const btCollisionObject& object, const Body& body) { entries_[&object] = {&body, body.traits}; }
  void strike(const btCollisionObject& object) { entries_.erase(&object); }

  struct Entry {
    const Body* body;
    Traits traits;

    Side side(const btCollisionObject& object, const btVector3& place) const {
      return {&object, body, traits.map != nullptr ? traits.map->at(place) : traits.material};
    }
  };
  /// Null for what was not entered.
  const Entry* find(const btCollisionObject& object) const {
    const auto found = entries_.find(&object);
    return found == entries_.end() ? nullptr : &found->second;
  }

 private:
  std::unordered_map<const btCollisionObject*, Entry> entries_;
};

}  // namespace cairn::effects
