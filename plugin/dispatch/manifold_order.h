// SPDX-License-Identifier: Zlib
#pragma once

class btCollisionDispatcher;

namespace cairn::bullet {

/// Puts a dispatcher's manifolds into an order that their bodies and points alone tell: by the ids the broad phase gave
/// the bodies, between the same two by their points. `btCollisionDispatcherMt` lines up what its threads made by which
/// thread made it, so the solver would solve worlds with Bullet's own shapes in another order every time. Linear where
/// they are in order, as mostly; else n log n. Precondition: no pass is under way, and nobody keeps a place in the
/// list.
void orderManifolds(btCollisionDispatcher& dispatcher);

}  // namespace cairn::bullet
