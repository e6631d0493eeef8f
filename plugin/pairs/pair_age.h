// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "contacts/relative_placement.h"

namespace cairn::bullet {

/// What a pair's manifolds hold.
struct ReportedContacts {
  bool mayHavePoints = false;
  bool wasSpeculative = false;   ///< contacts ahead were written in the last step
  bool areGuardsLoaded = false;  ///< in the step that was looked at last
  std::uint32_t contacts = 0, manifolds = 0;
};

/// How old that is. Steps that only follow the bodies count as waiting.
struct PairAge {
  bool isPlaced = false;  ///< `PairMotion::relative` tells where the bodies were when it was last begun, or held first
  bool isCarriedOver = false;    ///< in the step before
  bool repeatsLast = false;      ///< what was said last suffices
  float moved = 0;               ///< world length, by which the bodies moved since it was begun
  float uncounted = 0;           ///< the same, when it was begun in this step: nobody has counted it yet
  float unseenMotion = 0;        ///< world length, at most, in steps that were late for it
  double waited = 0;             ///< steps
  double error = 0;              ///< of what was said last, as a fraction of the smaller body's size
  RelativePlacement answeredAt;  ///< when it was last finished
};

}  // namespace cairn::bullet
