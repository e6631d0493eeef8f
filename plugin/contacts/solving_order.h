// SPDX-License-Identifier: Zlib
#pragma once

class btPersistentManifold;

namespace cairn::bullet {

/// Puts a manifold's points in the order in which Bullet's solver is to ask them: those that it is told are deepest
/// last.
///
/// Bullet asks one point after the other, a fixed number of rounds, and what a later point asks undoes a part of what
/// an earlier one got: the points asked first stay the deepest. If they are the same in every step, a body leans
/// towards them for as long as it rests, what stands on it leans farther, and stacks creep aside. With the deepest
/// asked last the points end equally deep, and bodies stand upright. Not for what moves: where it rolls, other points
/// are the deepest in every step, and asked last they brake.
///
/// Points of equal distance keep their order. Bullet knows its points by their positions: whoever holds the address of
/// one must look it up anew, as after `removeContactPoint`. Constant time.
void putDeepestLast(btPersistentManifold& manifold);

}  // namespace cairn::bullet
