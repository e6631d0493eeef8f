// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "cairn/core/export.h"

class btCollisionDispatcher;
class btDispatcher;
class btPersistentManifold;

namespace cairn::bullet {

/// Sorts manifolds by data of their bodies and points alone: first by the ids that the broad phase gave the bodies,
/// then by the points. The result does not depend on when or by which thread a manifold was made. For solvers that
/// `OrderedSolver` cannot extend:
///
///     cairn::bullet::orderManifolds({manifolds, std::size_t(count)}, dispatcher);  // in your solveGroup
///
/// `dispatcher` is the maker of the manifolds. The span may be its own list, which Bullet hands to the solver when
/// islands are not split; the dispatcher then still finds its manifolds. Precondition: no pass is under way, and nobody
/// remembers an index in the list. Cost: linear for a sorted list, else n log n.
CAIRN_BULLET_EXPORT
void orderManifolds(std::span<btPersistentManifold*> manifolds, btDispatcher& dispatcher);

/// Sorts all manifolds of a dispatcher. `btCollisionDispatcherMt` lists manifolds by the thread that made them. With
/// Bullet's own shapes the solver would then see another order in every run. `Dispatcher<btCollisionDispatcherMt>`
/// calls this after each pass.
CAIRN_BULLET_EXPORT
void orderManifolds(btCollisionDispatcher& dispatcher);

/// Registers the exact class of `solver`, an object with virtual functions, as an ordered solver; returns true. It
/// works without run-time type information. May be called from any thread.
CAIRN_BULLET_EXPORT bool rememberOrderedSolver(const void* solver);
/// Whether the exact class of `solver` was registered. May be called from any thread.
CAIRN_BULLET_EXPORT bool isOrderedSolver(const void* solver);

}  // namespace cairn::bullet
