// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// The deepest leaf pairs that an unfinished traversal has found and measured in earlier steps. They represent all of
/// them at the end, so that the final measurement has bounded cost.
class FoundPairs {
 public:
  static constexpr std::size_t kMax = 32;

  /// Allocates all memory that `add` needs, once.
  void makeRoom();
  void clear();
  /// Keeps the leaf pairs of these contacts that are deeper than the present ones, once each. Linear time.
  void add(std::span<const Contact> contacts);
  /// The leaf pairs, unordered. Valid until the next `add`.
  std::span<const NodePair> pairs() const { return pairs_; }

 private:
  void put(const Contact& contact);

  std::vector<NodePair> pairs_;
  std::vector<float> separations_;  // of `pairs_`, when they were measured
};

}  // namespace cairn::bullet
