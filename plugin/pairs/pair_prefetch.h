// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// The parts of a pair that a step reads together.
enum class PairPart {
  subject,   ///< read by `cullSeparated`
  copies,    ///< written by `collect`, with the data about the bodies
  estimate,  ///< the same, and the data that `estimate` reads
  notes,
  // From `begin` to `finish`, in three stages: each reads what the one before prefetches.
  state,
  lists,
  leafPairs,
  // The same for `carryOver`.
  carriedOver,
  carriedBodies,
  points,
};

/// Prefetches a part of the pair; changes nothing but time.
void prefetch(const TreePair& pair, PairPart part);

}  // namespace cairn::bullet
