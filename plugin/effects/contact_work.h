// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/effects/effect_set.h"

namespace cairn::effects {

/// Whether the solver did anything at a contact. Friction may stay where the normal impulse has gone back to nothing.
bool wasAtWork(const Contact& contact);

/// What the solver did at a contact: across its surface and along it. After it has solved, before normals are put back
/// or impacts act. An impulse's work is by the middle of the velocities before and after, which is exact for whatever
/// else acts in the step but gravity.
struct ContactWork {
  explicit ContactWork(const Contact& contact);

  Work across, along;
};

}  // namespace cairn::effects
