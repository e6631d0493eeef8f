// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Properties of a world's objects. Objects are looked up and never iterated, so the order of a hash table decides
/// nothing.
class SideBook {
 public:
  void enter(const btCollisionObject& object, const Traits& traits) {
    entries_[&object] = {nullptr, traits};
    change();
  }
  /// `body` must stay where it is.
  void enter(const btCollisionObject& object, const Body& body) {
    entries_[&object] = {&body, body.traits};
    change();
  }
  void strike(const btCollisionObject& object) {
    entries_.erase(&object);
    change();
  }

  /// Another number whenever something was entered or struck.
  std::uint64_t version() const { return version_; }
  /// Whether `pairs` is true of any two materials that the objects have; of all, as far as is known, if one has
  /// several.
  template <class Pairs>
  bool anyTwo(const Pairs& pairs) const {
    std::vector<MaterialId> materials;
    for (const auto& [object, entry] : entries_) {
      if (entry.traits.map != nullptr) return true;
      if (std::ranges::find(materials, entry.traits.material) == materials.end())
        materials.push_back(entry.traits.material);
    }
    return std::ranges::any_of(materials, [&](MaterialId a) {
      return std::ranges::any_of(materials, [&](MaterialId b) { return pairs(a, b); });
    });
  }

  struct Entry {
    const Body* body;
    Traits traits;

    Side side(const btCollisionObject& object, const btVector3& place) const {
      return {&object, body, traits.map != nullptr ? traits.map->at(place) : traits.material};
    }
  };
  /// Null for what was not entered. An object that keeps its place in the world is found there; others by their hash.
  const Entry* find(const btCollisionObject& object) {
    const auto place = static_cast<std::size_t>(object.getWorldArrayIndex());
    if (place < places_.size() && places_[place].object == &object) return places_[place].entry;
    const auto found = entries_.find(&object);
    const Entry* entry = found == entries_.end() ? nullptr : &found->second;
    if (object.getWorldArrayIndex() >= 0) {
      if (places_.size() <= place) places_.resize(place + 1);
      places_[place] = {&object, entry};
    }
    return entry;
  }

 private:
  struct Place {
    const btCollisionObject* object = nullptr;
    const Entry* entry = nullptr;
  };

  void change() {
    places_.clear();
    ++version_;
  }

  std::unordered_map<const btCollisionObject*, Entry> entries_;
  std::uint64_t version_ = 1;
  std::vector<Place> places_;  // by place in the world, since something was last entered
};

}  // namespace cairn::effects
