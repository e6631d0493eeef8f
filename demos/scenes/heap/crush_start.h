// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/result.h"
#include "scenes/heap/interpenetration.h"

namespace cairn::scenes {

/// Bodies pressed into each other, as no simulation should ever leave them.
struct CrushStart {
  std::vector<btTransform> poses;
  Spread depth;  ///< of the meshes in each other, fractions of body size
};

/// No pair starts deeper than this, as a fraction of body size.
inline constexpr double kDeepestStartFraction = 0.25;

/// Bodies on a cubic grid of a third of their size, shaken by a twentieth, at random orientations, the lowest just
/// above the ground z = 0, around the middle. Where some pair would be deeper than `kDeepestStartFraction` the grid is
/// widened until none is. Twenty bunnies: some eighty pairs, as deep as the mesh is thick. A pure function of model,
/// count and seed; seconds. Fails if the mesh is not closed.
Result<CrushStart> crushStart(const Model& model, std::uint32_t bodies, std::uint64_t seed);

}  // namespace cairn::scenes
