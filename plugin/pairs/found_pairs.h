// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Of the leaf pairs that a traversal over several steps has found and measured before it was done: the deepest. They
/// stand for the rest when all of it is told, so that what is measured then is bounded however many there were.
class FoundPairs {
 public:
  static constexpr std::size_t kMax = 32;

  /// Allocates, once, all that `add` needs.
  void makeRoom();
  void clear();
  /// Keeps those of these contacts' pairs that are deeper than what is there, once each. Linear.
  void add(std::span<const Contact> contacts);
  /// In no order. Valid until the next `add`.
  std::span<const NodePair> pairs() const { return pairs_; }

 private:
  void put(const Contact& contact);

  std::vector<NodePair> pairs_;
  std::vector<float> separations_;  // of `pairs_`, when they were measured
};

}  // namespace cairn::bullet
