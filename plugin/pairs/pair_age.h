// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "contacts/relative_placement.h"

namespace cairn::bullet {

/// The contents of a pair's manifolds.
struct ReportedContacts {
  bool mayHavePoints = false;
  bool wasSpeculative = false;   ///< the last step wrote speculative contacts
  bool areGuardsLoaded = false;  ///< guards carried load in the last step that was checked
  std::uint32_t contacts = 0, manifolds = 0;
};

/// The age of these contents. Steps that only carry contacts over count as waiting.
struct PairAge {
  bool isPlaced = false;  ///< `PairMotion::relative` holds the poses of the last beginning, or of the first carry-over
  bool isCarriedOver = false;    ///< the pair was carried over in the step before
  bool repeatsLast = false;      ///< the last answer suffices
  float moved = 0;               ///< world length; the bodies' relative motion since the pair was begun
  float uncounted = 0;           ///< the part of `moved` that nobody has counted, if the pair was begun in this step
  float unseenMotion = 0;        ///< world length; bound on the motion in steps that were too late for this pair
  double waited = 0;             ///< steps
  double error = 0;              ///< of the last answer, as a fraction of the smaller body's size
  RelativePlacement answeredAt;  ///< poses of the last answer
};

}  // namespace cairn::bullet
