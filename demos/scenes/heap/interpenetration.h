// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "cairn/core/result.h"
#include "scenes/figures/spread.h"
#include "scenes/truth/exact_check.h"
#include "scenes/world/body_scene.h"

namespace cairn::scenes {

/// The errors of a scene's body poses, as fractions of body size.
struct Interpenetration {
  Spread depth;     ///< penetration of the meshes of body pairs; over the pairs that penetrate
  Spread gap;       ///< distance between the meshes of pairs whose contacts carry load
  Spread pitDepth;  ///< penetration of bodies into ground or walls; over those that penetrate
  Spread pitGap;    ///< distance from ground or wall of bodies with loaded contacts there
};

/// Accuracy of the depths above, as a fraction of body size.
inline constexpr double kDepthToleranceFraction = 0.0005;

/// Judges the current poses of a scene by `ExactSurface`, independently of the shapes. Loads come from `ContactLoads`.
/// Takes seconds for a hundred bodies of 1500 triangles. Fails if the mesh is not a closed manifold.
Result<Interpenetration> measureInterpenetration(const BodyScene& scene);

/// Returns the penetrations between bodies of one model, over the pairs that penetrate, as fractions of body size.
Spread penetrations(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses);

/// Returns the greatest penetration alone, for a fraction of the time.
double worstPenetration(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses);

}  // namespace cairn::scenes
