// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/mass_properties.h"

namespace cairn::builder {

/// Integrals of 1, x and x x^T over a body.
struct Moments {
  double volume = 0;
  Vec3d first;
  Mat3d second{{Vec3d{}, Vec3d{}, Vec3d{}}};
};

/// Mass properties from the integrals of a body of density 1, taken about `reference`. Axes as in `massPropertiesOf`.
/// Precondition: the volume is above 0.
MassProperties massFromMoments(const Moments& moments, const Vec3d& reference);

/// Volume, centre of mass and inertia of the solid a closed mesh bounds, at density 1: exact integrals over the signed
/// tetrahedra between a point and the faces (Mirtich 1996; Eberly 2002). Each principal axis points so that its largest
/// coordinate is positive, except the third, which completes a right-handed frame; where the inertia is diagonal up to
/// rounding the axes are the mesh's. Precondition: `checkMesh(mesh)`. Linear.
MassProperties massPropertiesOf(const TriangleMesh& mesh);

/// The signed volume alone: negative for an inside-out mesh. Meaningful for any closed mesh.
double signedVolume(const TriangleMesh& mesh);

}  // namespace cairn::builder
