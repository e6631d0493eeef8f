// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cairn/effects/effect.h"
#include "open_blows.h"
#include "side_book.h"

class btDispatcher;
class btPersistentManifold;

namespace cairn::effects {

/// Which contacts somebody wants to see.
class WantedContacts {
 public:
  /// The combined properties of two materials.
  static constexpr unsigned kNothing = 0, kContacts = 1, kImpacts = 2;

  void add(const Hooks& hooks);
  unsigned of(MaterialId a, MaterialId b);
  /// Whether anything is wanted of any two of the objects.
  bool anyOf(const SideBook& book);
  /// Whether nobody wants contacts but for the impacts they form.
  bool onlyImpacts() const { return onlyImpacts_; }

 private:
  static constexpr unsigned kUnknown = ~0U;

  std::vector<Hooks> hooks_;
  PairTable<unsigned> known_{kUnknown};
  std::uint64_t version_ = 0;  // of the book, when `any_` was found
  bool any_ = false, onlyImpacts_ = true;
};

/// The contacts of one step that are wanted, whose objects are both known and not both at rest, and which pairs of
/// objects may strike each other through them. In the order of the dispatcher's manifolds, those last that are wanted
/// for their impacts alone; impacts in the order of the objects in the world. Rooms are kept from step to step.
class StepContacts {
 public:
  /// Before the solver. Linear in the manifolds, and logarithmic in the impacts for each.
  void gather(btDispatcher& dispatcher, SideBook& book, WantedContacts& wanted);
  std::span<Contact> contacts() { return contacts_; }
  /// After the solver: the impacts that are over, with their impulses.
  std::span<const Impact> finish();
  /// An object is leaving.
  void forgetBlowsOf(const btCollisionObject& object) { blows_.drop(object); }

 private:
  // A manifold's contacts, listed or left until it is known that its pair is fast.
  struct Range {
    std::uint64_t pair;  // the objects' places in the world, the smaller one above
    btPersistentManifold* manifold;
    std::uint32_t first, end;
    bool isFast;
  };

  void add(btPersistentManifold& manifold, SideBook& book, WantedContacts& wanted);
  static unsigned wishesFor(const btPersistentManifold& manifold, SideBook& book, WantedContacts& wanted);
  static bool hasFast(const btPersistentManifold& manifold);
  void list(Range& range, SideBook& book);
  void formImpacts(SideBook& book, WantedContacts& wanted);
  void join(const Range& range, Impact& impact, std::int32_t number);

  std::vector<Contact> contacts_;
  std::vector<Range> ranges_;  // one for each manifold
  std::vector<std::uint64_t> pairs_;
  std::vector<Impact> impacts_;
  OpenBlows blows_;
};

}  // namespace cairn::effects
