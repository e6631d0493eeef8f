// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/tree_pair.h"

namespace cairn::bullet {

/// What a step looks at of a pair.
enum class PairPart {
  subject,  ///< what `settleApart` looks at
  copies,   ///< what `collect` writes, and what tells of the bodies
  need,     ///< the same, and what `survey` looks at
  notes,
  // From `begin` to `finish`, in three goes, each of which looks at what the one before fetches.
  state,
  lists,
  leafPairs,
  // What `hold` looks at, likewise.
  held,
  heldBodies,
  points,
};

/// See `fetchAhead`; changes nothing.
void fetch(const TreePair& pair, PairPart part);

}  // namespace cairn::bullet
