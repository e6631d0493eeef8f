// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "cairn/core/result.h"
#include "scenes/figures/spread.h"
#include "scenes/truth/exact_check.h"
#include "scenes/world/body_scene.h"

namespace cairn::scenes {

/// Where the bodies of a scene are wrong, as fractions of body size.
struct Interpenetration {
  Spread depth;     ///< of pairs of bodies, one mesh in the other; over the pairs that penetrate
  Spread gap;       ///< distance between the meshes of pairs whose contacts carry load
  Spread pitDepth;  ///< of bodies in the ground or the pit's walls; over those that penetrate
  Spread pitGap;    ///< distance from ground or wall of bodies with loaded contacts there
};

/// Accuracy of the depths above, as a fraction of body size.
inline constexpr double kDepthToleranceFraction = 0.0005;

/// Judges a scene as it stands by `ExactSurface`, independently of the shapes. Load is what
/// `ContactLoads` finds. Seconds for a hundred bodies of 1500 triangles. Fails if the mesh is not a closed manifold.
Result<Interpenetration> measureInterpenetration(const BodyScene& scene);

/// How deep bodies of one model reach into each other, over the pairs that do, as fractions of body size.
Spread penetrations(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses);

/// The greatest of these alone, for a fraction of the time.
double worstPenetration(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses);

}  // namespace cairn::scenes
