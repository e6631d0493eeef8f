// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <span>

#include "continuous/sweep.h"

namespace cairn::bullet {

/// Continuous collision of a pair: what fast bodies run into.
struct PairTrajectory {
  bool isFast = false;                   ///< a body moves far in this step
  std::unique_ptr<Sweep> sweep;          ///< made when it is first needed
  std::span<const Contact> speculative;  ///< found in this step

  /// Whether a part has sunk in or might have, so that the next step must look for it too.
  bool isAnchored() const { return sweep && sweep->isAnchored(); }
  void forgetAnchor() {
    if (sweep) sweep->forget();
  }
};

}  // namespace cairn::bullet
