// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/mass_properties.h"

namespace cairn::builder {

/// Volume, centre of mass and inertia of the solid a closed mesh bounds, at density 1: exact integrals over the signed
/// tetrahedra between a point and the faces (Mirtich 1996; Eberly 2002). Each principal axis points so that its largest
/// coordinate is positive, except the third, which completes a right-handed frame; where the inertia is diagonal up to
/// rounding the axes are the mesh's. Precondition: `checkMesh(mesh)`. Linear.
MassProperties massPropertiesOf(const TriangleMesh& mesh);

/// The signed volume alone: negative for an inside-out mesh. Meaningful for any closed mesh.
double signedVolume(const TriangleMesh& mesh);

}  // namespace cairn::builder
