// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Blows that take more than one step. Bullet stops a body that is about to touch in two steps: the first closes the
/// rest of the distance, the second takes the speed. Each alone would be half a blow at the wrong speed. So a blow is
/// reported when it is over, with the motion before its first step and the impulses of all its steps.
class OpenBlows {
 public:
  /// Before the solver: gives pairs whose blow goes on what they had when it began.
  void inherit(std::span<Impact> pending);

  /// After the solver, impulses of this step filled in: the blows that are over, those that came to nothing after all
  /// left out. The span holds until the next call.
  std::span<const Impact> settle(std::span<const Impact> pending);

  /// An object is leaving: its blows do not go on.
  void drop(const btCollisionObject& object);

 private:
  struct Blow {
    Impact impact;
    bool goesOn = false;
  };

  std::vector<Blow> open_, next_;
  std::vector<Impact> over_;
};

}  // namespace cairn::effects
