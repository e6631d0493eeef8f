// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Spheres that keep two bodies from each other while nothing newer is known: they may not approach further until they
/// are resolved.
class PairGuards {
 public:
  static constexpr std::size_t kMax = 4;

  // Bodies may roll for minutes before there are as many as can be.
  PairGuards() { guards_.reserve(kMax); }

  bool isEmpty() const { return guards_.empty(); }
  void clear() { guards_.clear(); }
  /// Whether the same sphere, or, of whole bodies, one that faced the same way, was a guard in the last step.
  bool had(const Contact& guard) const { return lastOf(guard) != nullptr; }
  /// Those of the candidates, in any order before and after, that matter most, with the gaps that the solver is told;
  /// appended to `contacts`.
  void choose(std::vector<Contact>& candidates, float smallerSize, std::vector<Contact>& contacts);
  /// The spheres of whole bodies as a guard, in place of what faced the same way: reports what they have sunk since
  /// they were first seen.
  Contact guardByRoot(Contact whole, float smallerSize);

 private:
  // How far a pair of spheres already overlapped when it was first seen, and what it has sunk since.
  struct Guard {
    ContactId id;  // of the collider's own elements, whose positions in a traversal may change
    bool isRootContact;
    Vec3 normal;
    float allowedSeparation;
    float sunk;
  };

  static Guard noted(const Contact& guard, float allowedSeparation);
  const Guard* lastOf(const Contact& guard) const;
  float allowedSeparation(const Contact& guard, float smallerSize) const;

  std::vector<Guard> guards_;
};

}  // namespace cairn::bullet
