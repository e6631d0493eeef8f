// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/effects/effect.h"
#include "open_blows.h"
#include "side_book.h"

class btDispatcher;
class btPersistentManifold;

namespace cairn::effects {

/// The contacts of one step whose objects are both known and not both at rest, and which pairs of objects may strike
/// each other through them. In the order of the dispatcher's manifolds; impacts in that of the objects in the world.
/// Rooms are kept from step to step.
class StepContacts {
 public:
  /// Before the solver. Linear in the manifolds, and logarithmic in the impacts for each.
  void gather(btDispatcher& dispatcher, const SideBook& book);
  std::span<Contact> contacts() { return contacts_; }
  /// After the solver: the impacts that are over, with their impulses.
  std::span<const Impact> finish();
  /// Objects are leaving.
  void forgetBlows() { blows_.drop(); }

 private:
  struct Range {
    std::uint64_t pair;  // the objects' places in the world, the smaller one above
    std::size_t first, end;
    bool isFast;
  };

  void add(btPersistentManifold& manifold, const SideBook& book);
  void formImpacts();
  void join(const Range& range, Impact& impact, std::int32_t number);

  std::vector<Contact> contacts_;
  std::vector<Range> ranges_;  // one for each manifold
  std::vector<std::uint64_t> pairs_;
  std::vector<Impact> impacts_;
  OpenBlows blows_;
};

}  // namespace cairn::effects
