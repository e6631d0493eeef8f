// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// Lengths are fractions of the bounding box's diagonal.
struct WrapOptions {
  double alpha = 0.02;  ///< openings narrower than about this are closed; kMinAlpha..1
  double offset =
      0.002;  ///< how far outside the surface the wrap keeps, about (a tenth less at times); kMinOffset..0.2
};
inline constexpr double kMinAlpha = 0.005, kMaxAlpha = 1;     ///< the range of `WrapOptions::alpha`
inline constexpr double kMinOffset = 1e-4, kMaxOffset = 0.2;  ///< the range of `WrapOptions::offset`

/// A closed skin around a surface, and how far it is from it. Mesh frame and unit.
struct Wrap {
  TriangleMesh mesh;         ///< closed, and around the original
  double farthestUpper = 0;  ///< proved: no point of the wrap's surface is farther from the original surface
  double farthestLower = 0;  ///< proved: `witness` is at least this far
  Vec3d witness;             ///< a point of the wrap's surface, up to rounding
};

/// Encloses any surface (open, crossing itself, a soup of triangles) in a closed one without self-intersections: alpha
/// wrapping (Portaneri et al. 2022), the automatic skinning of thesis 8.3.4. Proved afterwards, independently of how
/// the wrap was made: it passes `checkMesh`, every triangle of the original lies strictly inside it, and the farthest
/// of its points from the original is enclosed to 1 % or 1e-4 of the diagonal.
///
/// So a point within e of the wrap's solid, and not inside it, is within e + farthestUpper of the original surface.
/// That is what "error against the original" means here, for open surfaces too: a distance to the surface. What the
/// wrap encloses counts as solid, including hollows whose openings it closed.
///
/// Coordinates are floats; it is the mesh `importMesh` reads from `plyBytes`, whose SHA-256 it carries. Fails for
/// options out of range, when a proof does not hold (a float cannot tell the wrap from the surface: far from the
/// mesh's own origin), when it would need more than a million vertices, and with `kCancelled`. The same bits every
/// time. Precondition: a mesh of `importSurface`. Single thread; about a second for 10 000 triangles of the wrap.
Result<Wrap> wrap(const TriangleMesh& surface, const WrapOptions& options, const ProgressCallback& progress = {});

}  // namespace cairn::builder
