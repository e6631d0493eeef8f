// SPDX-License-Identifier: Zlib
#pragma once

class btTriangleCallback;

namespace cairn::bullet {

class TerrainLattice;

/// Serves one of Bullet's rays or convex sweeps along its path; returns false, and does nothing, for other callbacks.
/// The callback gets the triangles it could accept, near cells first, until its hit fraction excludes the rest. The
/// callback itself decides hits. Cost: the blocks below the path, and the cells of those blocks whose heights it meets.
bool answerCast(const TerrainLattice& lattice, btTriangleCallback& callback);

}  // namespace cairn::bullet
