// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/bullet/narrow_phase.h"
#include "cairn/core/result.h"

class btCollisionDispatcher;
class btCollisionWorld;

namespace cairn::bullet {

/// Two ways in for a program whose dispatcher is made already; whoever makes it takes a `Dispatcher`. Both return the
/// narrow phase, whose owner they make you: while it lives, sphere-trees collide under its budget; when it dies,
/// everything is as it was before.
///
///     auto cairn = cairn::bullet::install(world);
///     if (!cairn) return fail(cairn.error().message);
///     if (!cairn.value().setBudget({.operations = 50000})) return 1;
///
/// **Lifetime.** It must die before the world or dispatcher it was installed on, as it does when declared after them:
/// Bullet tells nobody when these die, so afterwards is undefined behaviour. Not while either is dispatching (asserted;
/// a contact callback is such a place). Several may be installed on one world or dispatcher one after the other, never
/// two at once (an error). What others have replaced since, an assertion says and the new value is left alone.

/// On a world, whatever its kind and solver: the same answers as by a `Dispatcher`, bit for bit. Costs two calls a
/// step.
///
/// The end of Bullet's pass over the pairs is seen by a broad phase that hands everything on to the one there was, and
/// whose pair cache tells when that pass begins and ends: while installed, `world.getBroadphase()` is not the object
/// you made (which you may go on using directly), so do not cast it down. Pairs that Bullet already knew are taken over
/// in the next step, and given back when the narrow phase dies; contacts of such pairs end and start again, and with
/// them those of all compounds when it dies.
///
/// An error when the world has no `btCollisionDispatcher`, one that has sphere-trees registered, or a
/// `btCollisionDispatcherMt` (which asks the pair cache for no pass; use `Dispatcher<btCollisionDispatcherMt>`).
Result<NarrowPhase> install(btCollisionWorld& world);

/// On a dispatcher alone, for whoever cannot reach the world. A stock dispatcher says neither when a step begins nor
/// when it ends, and contacts cannot wait: when the first pair of a step comes, all pairs seen before are refined
/// together at the poses their bodies have now, and each answers from that when its turn comes. A part of the budget is
/// kept for pairs that are new, as many as came in the step before; what they do not need lapses.
///
/// A step has begun when a pair comes a second time, or a new one after bodies that have moved, or after `beginFrame`.
/// So refinement keeps the budget exactly in every step in which something moves; where nothing did, pairs that appear
/// before any known one count as the last step's. Bodies moved by contact callbacks in mid-step begin another step.
/// Pairs of ghost objects are answered at once and in full, even those of the world's own pass.
///
/// `lastStep()` is the step at hand so far, pairs that are still expected with what they answered last, and stays what
/// it is in steps without any sphere-tree; its `microseconds` are elapsed time in the narrow phase alone. Pairs that
/// Bullet knew before keep Bullet's algorithms (clean them from the pair cache); those it knows when the narrow phase
/// dies are answered at once and in full until it drops them. Do not share the dispatcher between worlds (they would
/// share the steps), and let no algorithm made by hand with `findAlgorithm` outlive its bodies.
///
/// An error when sphere-trees are registered already, or for a `btCollisionDispatcherMt`.
Result<NarrowPhase> install(btCollisionDispatcher& dispatcher);

}  // namespace cairn::bullet
