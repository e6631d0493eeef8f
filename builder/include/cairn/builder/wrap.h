// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Options of `wrap`. Lengths are fractions of the bounding box's diagonal.
struct WrapOptions {
  double alpha = 0.02;  ///< openings narrower than about this are closed; kMinAlpha..kMaxAlpha
  /// Approximate distance of the wrap outside the surface, at times a tenth less; kMinOffset..kMaxOffset.
  double offset = 0.002;
  /// The greatest distance of the wrap's surface from the original that is accepted; kMinWrapDistance..kMaxOffset.
  /// Where the first skin is farther, alpha and offset shrink until one is near enough: time grows with the square.
  std::optional<double> maxDistance = {};
};
inline constexpr double kMinAlpha = 0.002, kMaxAlpha = 1;     ///< range of `WrapOptions::alpha`
inline constexpr double kMinOffset = 1e-4, kMaxOffset = 0.2;  ///< range of `WrapOptions::offset`
inline constexpr double kMinWrapDistance = 2e-3;              ///< least `WrapOptions::maxDistance`

/// A closed skin around a surface, and its distance from the surface. Mesh frame and unit.
struct Wrap {
  TriangleMesh mesh;         ///< closed, around the original
  double alpha = 0;          ///< with which it was made, a fraction of the diagonal
  double offset = 0;         ///< likewise
  double farthestUpper = 0;  ///< proved: no point of the wrap's surface is farther from the original surface
  double farthestLower = 0;  ///< proved: `witness` is at least this far from the original surface
  Vec3d witness;             ///< a point of the wrap's surface, up to rounding
};

/// Encloses any surface (open, self-intersecting, a soup of triangles) in a closed one without self-intersections. The
/// method is alpha wrapping (Portaneri et al. 2022), the automatic skinning of thesis 8.3.4. Three properties are
/// proved afterwards, independently of the construction. The wrap passes `checkMesh`. Every triangle of the original
/// lies strictly inside it. The largest distance from the original to the wrap's surface is enclosed to 1 % or 1e-4 of
/// the diagonal.
///
/// So a point outside the wrap's solid, but within e of it, is within e + farthestUpper of the original surface. This
/// is the meaning of "error against the original", also for open surfaces: a distance to the surface. Everything that
/// the wrap encloses counts as solid, including hollows whose openings it closed.
///
/// Coordinates are floats. The result equals the mesh that `importMesh` reads from `plyBytes`, and carries the SHA-256
/// of these bytes. Fails for options out of range, for a wrap of more than a million vertices, and with `kCancelled`.
/// Also fails when `kMinAlpha` is not fine enough for `maxDistance`, and when a proof does not hold: far from the
/// mesh's own origin a float cannot separate the wrap from the surface. The result has the same bits every time.
///
/// Precondition: a mesh of `importSurface`. Single thread; about a second for 10 000 triangles of the wrap.
///
///     Wrap skin = wrap(importSurface("soup.stl").value(), {.alpha = 0.05}).value();
Result<Wrap> wrap(const TriangleMesh& surface, const WrapOptions& options, const ProgressCallback& progress = {});

}  // namespace cairn::builder
