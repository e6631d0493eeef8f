// SPDX-License-Identifier: Zlib
#pragma once

class btPersistentManifold;

namespace cairn::bullet {

/// Sorts a manifold's points for Bullet's solver: the point with the least distance comes last.
///
/// Bullet solves one point after the other, for a fixed number of rounds, and each later point undoes part of an
/// earlier one's impulse. So the points solved first stay the deepest. If they are the same in every step, a resting
/// body leans towards them, bodies on it lean farther, and stacks creep aside. With the deepest point solved last, the
/// points end equally deep and bodies stand upright. Do not use it for moving bodies. Where a body rolls, other points
/// are the deepest in every step, and solved last they brake it.
///
/// Points of equal distance keep their order. Points move in memory: look up any point again whose address you hold, as
/// after `removeContactPoint`. Constant time.
void putDeepestLast(btPersistentManifold& manifold);

}  // namespace cairn::bullet
