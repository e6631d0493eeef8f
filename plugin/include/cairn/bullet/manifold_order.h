// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

class btCollisionDispatcher;
class btDispatcher;
class btPersistentManifold;

namespace cairn::bullet {

/// Puts manifolds into an order that their bodies and points alone tell: by the ids the broad phase gave the bodies,
/// between the same two by their points. Who made them when does not show. For solvers that `OrderedSolver` cannot
/// extend. `dispatcher` is the one that made them; if it is its own list that is put in order (Bullet hands that to the
/// solver where islands are not split), it still finds them in it. Precondition: no pass is under way, and nobody keeps
/// a place in the list. Linear where they are in order; else n log n.
void orderManifolds(std::span<btPersistentManifold*> manifolds, btDispatcher& dispatcher);

/// The same with all of a dispatcher's. `btCollisionDispatcherMt` lines up what its threads made by which thread made
/// it, so the solver would solve worlds with Bullet's own shapes in another order every time:
/// `Dispatcher<btCollisionDispatcherMt>` calls this after each pass.
void orderManifolds(btCollisionDispatcher& dispatcher);

}  // namespace cairn::bullet
