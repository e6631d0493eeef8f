// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/effects/effect_set.h"

namespace cairn::effects {

/// Whether the solver did anything at a contact. Friction may stay where the normal impulse has gone back to nothing.
bool wasAtWork(const Contact& contact);

/// The solver's work at a contact: across its surface and along it. It is computed after the solver, before normals are
/// restored and impacts act. An impulse's work uses the mean of the velocities before and after, which is exact for
/// everything in the step except gravity.
struct ContactWork {
  explicit ContactWork(const Contact& contact);

  Work across, along;
};

}  // namespace cairn::effects
