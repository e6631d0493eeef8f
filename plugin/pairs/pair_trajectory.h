// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <span>

#include "continuous/sweep.h"

namespace cairn::bullet {

/// Of bodies that move far in a step: what they run into.
struct PairTrajectory {
  bool isFast = false;                   ///< in this step
  std::unique_ptr<Sweep> sweep;          ///< made when it is first needed
  std::span<const Contact> speculative;  ///< of this step

  /// Whether something had sunk in, or might: it is looked for in the next step as well.
  bool isAnchored() const { return sweep && sweep->isAnchored(); }
  void forgetAnchor() {
    if (sweep) sweep->forget();
  }
};

}  // namespace cairn::bullet
