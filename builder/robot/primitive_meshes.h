// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// A box about the origin with these edges, twelve triangles.
TriangleMesh boxMesh(const Vec3d& edges);
/// A prism of `kPrismSides` sides about the axis z whose corners have this distance from it.
TriangleMesh prismMesh(double cornerRadius, double length);
/// The corner radius of the prism around a cylinder; its sides touch the cylinder.
double radiusAround(double cylinderRadius);

/// The solid of a box or a cylinder for an objective. Precondition: one of these.
RobotSolid primitiveSolid(const CollisionShape& shape, Objective objective);
/// Triangles inside a shape that is kept, corners on it. Precondition: no mesh.
TriangleMesh keptSurface(const CollisionShape& shape);

}  // namespace cairn::builder
