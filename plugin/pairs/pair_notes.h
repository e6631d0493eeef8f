// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>

#include "pairs/pair_report.h"

namespace cairn::bullet {

/// The dispatch's own data about a pair.
struct PairNotes {
  static constexpr std::uint64_t kUnnamed = ~std::uint64_t{0};
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  std::uint64_t id = kUnnamed;         ///< its name, which also decides in which of several steps it takes its turn
  bool isOfCompound = false;           ///< one of its bodies was a child of a compound
  std::size_t collectedAt = kNowhere;  ///< position among the pairs collected in this dispatch
  std::size_t knownAt = kNowhere;      ///< position among the pairs that an open step knows
  std::uint64_t answeredIn = 0;        ///< the last open step that answered it, counted from 1
  PairReport lastReport;               ///< of the last answer; valid until the next one
  bool isReported = false;             ///< whether there is one

  bool isUnnamed() const { return id == kUnnamed; }
  bool isCollected() const { return collectedAt != kNowhere; }
};

}  // namespace cairn::bullet
