// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

/// Keeps a narrow phase whose owner is gone but whose world or dispatcher may be gone too. Bullet reports the death of
/// neither. A world without objects, or a dispatcher without its pairs, may be dead, so neither is touched. The narrow
/// phase stays alive here, and undoes itself when a live world or dispatcher calls it.
void leaveBehind(std::shared_ptr<NarrowPhase::Impl> narrowPhase);

/// Undoes the narrow phases left on this dispatcher or world. Precondition: it is alive. Cost: linear in those left.
void takeAwayLeftBehind(btCollisionDispatcher& dispatcher);
void takeAwayLeftBehind(btCollisionWorld& world);

}  // namespace cairn::bullet
