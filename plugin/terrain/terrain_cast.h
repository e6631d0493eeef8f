// SPDX-License-Identifier: Zlib
#pragma once

class btTriangleCallback;

namespace cairn::bullet {

class TerrainLattice;

/// If the callback is one of Bullet's rays or convex sweeps, serves it along its way: the triangles it could accept,
/// near cells first, until its hit fraction says that nothing farther is wanted. What a hit is, remains the callback's
/// own business. False, and nothing is done, for all other callbacks.
/// Cost: the blocks below the way, and the cells below it of those blocks whose heights it passes.
bool answerCast(const TerrainLattice& lattice, btTriangleCallback& callback);

}  // namespace cairn::bullet
