// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>

#include "cairn/bullet/narrow_phase.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

/// Bullet tells nobody when a world or a dispatcher dies. A narrow phase that goes while its world holds no object (its
/// dispatcher no pair of it) cannot know whether they are still there, so it touches neither: what it has entered stays
/// alive here and undoes itself when it is asked for anything, which only the living do.
void leaveBehind(std::shared_ptr<NarrowPhase::Impl> narrowPhase);

/// Undoes what was left with these, which are alive. Linear in what was left.
void takeAwayLeftBehind(btCollisionDispatcher& dispatcher);
void takeAwayLeftBehind(btCollisionWorld& world);

}  // namespace cairn::bullet
