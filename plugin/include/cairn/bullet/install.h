// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/bullet/narrow_phase.h"
#include "cairn/core/export.h"
#include "cairn/core/result.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

/// Two ways to add Cairn to a dispatcher that already exists; if you create the dispatcher, use `Dispatcher`. Both
/// return a narrow phase that you own. While it lives, sphere-trees collide under its budget. Its destructor restores
/// the former state.
///
///     auto cairn = cairn::bullet::install(world);
///     if (!cairn) return fail(cairn.error().message);
///     if (!cairn.value().setBudget({.operations = 50000})) return 1;
///
/// **Lifetime.** The narrow phase may be destroyed before or after its world or dispatcher. Bullet reports the death of
/// neither. So a narrow phase destroyed while the world has no objects (while the dispatcher has no pair of trees)
/// touches neither. Both are restored when the next object comes, or the next narrow phase is installed. Do not destroy
/// it during a dispatch, for instance in a contact callback (asserted).
///
/// One world or dispatcher can have one narrow phase at a time; a second one is an error. A new one may follow the old
/// one. If other code replaced something that `install` had set, an assertion reports it and the new value stays.

/// Installs on a world of any class, with any solver. The answers equal those of a `Dispatcher` bit for bit. Cost: two
/// calls a step.
///
/// The narrow phase must see where Bullet's pass over the pairs begins and ends. So it puts a broad phase around yours,
/// which forwards all calls and whose pair cache reports the pass. While installed, `world.getBroadphase()` is
/// therefore not your object: do not cast it down. You may go on using your own object directly.
///
/// Pairs that Bullet knew already change over in the next step, and change back when the narrow phase is destroyed.
/// Their contacts end and start again. On destruction the contacts of all compounds start again too.
///
/// Fails when the world has no `btCollisionDispatcher`, or one with sphere-trees registered. Fails also for a
/// `btCollisionDispatcherMt`, which reports no pass to the pair cache; use `Dispatcher<btCollisionDispatcherMt>` there.
CAIRN_BULLET_EXPORT
Result<NarrowPhase> install(btCollisionWorld& world);

/// Installs on a dispatcher alone, for callers that cannot reach the world. A plain dispatcher reports neither the
/// begin nor the end of a step, and contacts cannot wait. So the first pair of a step refines all known pairs together,
/// at the present poses of their bodies. Each pair then answers from that result in its turn. Part of the budget is
/// reserved for new pairs, as many as came in the step before; the rest of this part lapses.
///
/// A step begins when a pair comes a second time, or a new pair after bodies have moved, or after `beginFrame`. So
/// every step in which something moves keeps its budget exactly. Where nothing moved, new pairs that come before any
/// known pair count as the last step's. If a contact callback moves bodies during a step, another step begins. Pairs of
/// ghost objects are answered at once and in full, even those of the world's own pass.
///
/// `lastStep()` describes the current step so far; pairs still expected count with their last answers. A step without
/// any sphere-tree leaves it unchanged. Its `microseconds` are elapsed time in the narrow phase alone.
///
/// Pairs that Bullet knew before keep Bullet's algorithms; clean them from the pair cache to change that. Pairs known
/// when the narrow phase is destroyed are answered at once and in full, until Bullet drops them. Do not share the
/// dispatcher between worlds, because they would share the steps. An algorithm that you made with `findAlgorithm` must
/// not outlive its bodies.
///
/// Fails when sphere-trees are registered already, and for a `btCollisionDispatcherMt`.
CAIRN_BULLET_EXPORT
Result<NarrowPhase> install(btCollisionDispatcher& dispatcher);

}  // namespace cairn::bullet
