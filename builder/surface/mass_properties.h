// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/mass_properties.h"

namespace cairn::builder {

/// Returns volume, centre of mass and inertia of the solid bounded by a closed mesh, at density 1. They are exact
/// integrals over the signed tetrahedra between a point and the faces (Mirtich 1996; Eberly 2002). The largest
/// coordinate of each principal axis is positive, except for the third, which completes a right-handed frame. Where the
/// inertia is diagonal up to rounding, the axes are the mesh's. Precondition: `checkMesh(mesh)`. Linear.
MassProperties massPropertiesOf(const TriangleMesh& mesh);

/// Returns the signed volume alone: negative for an inside-out mesh. Meaningful for any closed mesh.
double signedVolume(const TriangleMesh& mesh);

}  // namespace cairn::builder
