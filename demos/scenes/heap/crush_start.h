// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/heap/interpenetration.h"

namespace cairn::scenes {

/// Start poses of bodies that are pressed into each other more than any simulation should leave them.
struct CrushStart {
  std::vector<btTransform> poses;
  Spread depth;  ///< penetration of the meshes, fractions of body size
};

/// Largest penetration of a pair at the start, as a fraction of body size.
inline constexpr double kDeepestStartFraction = 0.25;

/// Places bodies on a cubic grid of a third of their size, displaced by a twentieth, at random orientations. The lowest
/// body is just above the ground z = 0; the grid is centred. Where some pair would be deeper than
/// `kDeepestStartFraction`, the grid is widened until none is. Twenty bunnies give some eighty pairs, as deep as the
/// mesh is thick. A pure function of model, count and seed. Takes seconds. Fails if the mesh is not closed.
Result<CrushStart> crushStart(const Model& model, std::uint32_t bodies, std::uint64_t seed);

}  // namespace cairn::scenes
