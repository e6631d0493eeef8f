// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/core/vec3.h"

namespace cairn {

/// Exact polyhedral integrals of a closed mesh at density 1 (Mirtich 1996; Eberly 2002).
struct MassProperties {
  double volume = 0;       ///< mesh unit cubed
  Vec3d centerOfMass;      ///< in the mesh's frame
  Mat3d inertia{};         ///< about the centre of mass, mesh axes, per unit of mass (mesh unit squared)
  Mat3d principalAxes{};   ///< columns: unit axes of the inertia, right-handed, ascending moments
  Vec3d principalMoments;  ///< per unit of mass

  friend bool operator==(const MassProperties&, const MassProperties&) = default;
};

}  // namespace cairn
