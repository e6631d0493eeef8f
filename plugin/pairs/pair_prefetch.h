// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// What a step looks at of a pair.
enum class PairPart {
  subject,   ///< what `cullSeparated` looks at
  copies,    ///< what `collect` writes, and what tells of the bodies
  estimate,  ///< the same, and what `estimate` looks at
  notes,
  // From `begin` to `finish`, in three goes, each of which looks at what the one before fetches.
  state,
  lists,
  leafPairs,
  // What `carryOver` looks at, likewise.
  carriedOver,
  carriedBodies,
  points,
};

/// See `prefetch`; changes nothing.
void prefetch(const TreePair& pair, PairPart part);

}  // namespace cairn::bullet
