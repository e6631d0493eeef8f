// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// What a pair is to tell Bullet's manifolds. Its contacts lie in the scratch that measured it, until `chosen` there is
/// cleared.
struct PairAnswer {
  PairReport report;                                        ///< but for what comes of it in the manifolds
  std::array<std::uint8_t, kMaxClusters> count{}, exact{};  ///< contacts of each manifold, and exact ones of these
  const std::vector<Contact>* list = nullptr;
  std::size_t first = 0;

  std::span<const Contact> all() const { return list ? std::span(*list).subspan(first) : std::span<const Contact>(); }
};

/// From what the traversal found to the contacts that Bullet gets, at most four of each manifold; redeems the promise.
/// Touches nothing but the pair, the budget and the scratch: several pairs may be measured at a time. Precondition:
/// begun in this step.
PairAnswer measure(TreePair& pair, const AnswerPolicy& policy, Budget& budget, ContactScratch& scratch);

}  // namespace cairn::bullet
