// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Guard contacts of a pair: bounding spheres that may not overlap further until the pair is resolved. The guards of a
/// locked pair act both ways: rings that hang in each other would come free by parting, not by approaching.
class PairGuards {
 public:
  static constexpr std::size_t kMax = 4;

  // Reserved at once: bodies may roll for minutes before a pair has as many guards as it can.
  PairGuards() { guards_.reserve(kMax); }

  bool isEmpty() const { return guards_.empty(); }
  void clear() {
    guards_.clear();
    isLocked_ = false;
  }
  /// Whether the guards of this step act both ways.
  void lock(bool isLocked) { isLocked_ = isLocked; }
  bool areLocked() const { return isLocked_; }
  /// Whether the same sphere was a guard in the last step. For root contacts: whether one with a similar normal was.
  bool had(const Contact& guard) const { return lastOf(guard) != nullptr; }
  /// Appends the most important candidates to `contacts`, with the separations for the solver. The order of the
  /// candidates does not matter, and changes.
  void choose(std::vector<Contact>& candidates, float smallerSize, std::vector<Contact>& contacts);
  /// Makes a root contact a guard, in place of a guard with a similar normal. Its separation is the overlap gained
  /// since it was first seen.
  Contact guardByRoot(Contact whole, float smallerSize);
  /// The other way of a locked pair's guard: its spheres may not part.
  static Contact oppositeOf(const Contact& guard, float smallerSize);

 private:
  // A pair of spheres: its overlap when it was first seen, and the overlap gained since.
  struct Guard {
    ContactId id;  // of the collider's elements, because positions in a traversal may change
    bool isRootContact;
    Vec3 normal;
    float allowedSeparation;
    float sunk;
  };

  void lockGuard(Contact& guard) const;
  static Guard noted(const Contact& guard, float allowedSeparation);
  const Guard* lastOf(const Contact& guard) const;
  float allowedSeparation(const Contact& guard, float smallerSize) const;

  std::vector<Guard> guards_;
  bool isLocked_ = false;
};

}  // namespace cairn::bullet
