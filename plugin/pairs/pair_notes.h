// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

#include "pairs/pair_report.h"

namespace cairn::bullet {

/// What the dispatch writes on a pair.
struct PairNotes {
  static constexpr std::uint64_t kUnnamed = ~std::uint64_t{0};
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  std::uint64_t id = kUnnamed;         ///< its name; says as well in which step of several it takes its turn
  bool isOfCompound = false;           ///< one of its sides was a child of a compound
  std::size_t collectedAt = kNowhere;  ///< position among the pairs collected in the current dispatch
  std::size_t knownAt = kNowhere;      ///< among the pairs an open step knows
  std::uint64_t answeredIn = 0;        ///< the last open step that answered it; they count from 1
  PairReport lastReport;               ///< what it said then: stands until it is answered again

  bool isUnnamed() const { return id == kUnnamed; }
  bool isCollected() const { return collectedAt != kNowhere; }
};

}  // namespace cairn::bullet
