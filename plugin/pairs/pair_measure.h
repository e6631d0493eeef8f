// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// A pair's new contacts for Bullet's manifolds. They lie in the scratch that measured them, until its `chosen` is
/// cleared.
struct PairAnswer {
  PairReport report;  ///< without the counts of manifolds
  std::array<std::uint8_t, kMaxClusters> count{},
      exact{};  ///< contacts of each manifold, and how many of them are exact
  const std::vector<Contact>* list = nullptr;
  std::size_t first = 0;

  std::span<const Contact> all() const { return list ? std::span(*list).subspan(first) : std::span<const Contact>(); }
};

/// Measures the contacts that Bullet gets, at most four a manifold, and releases the pair's reservation. It changes
/// only the pair, the budget and the scratch, so that threads may measure several pairs at a time. Precondition: the
/// pair was begun in this step.
PairAnswer measure(TreePair& pair, const AnswerPolicy& policy, Budget& budget, ContactScratch& scratch);

}  // namespace cairn::bullet
