// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::hard {

using Wide = BasicVec3<long double>;

/// Whether some leaf and all its ancestors contain the point (mesh frame): every ball searched that holds it, with the
/// floats the tree keeps taken as the reals they are, in extended precision and without a tolerance. It shares nothing
/// with the builder's own proof.
bool liesInAChain(const SphereTree& tree, const Wide& point);

/// A point of one of the mesh's triangles, each as likely, thin ones too; one in eight is a corner, one in eight lies
/// on an edge. It is off the triangle by the rounding of extended precision alone, 2^-62 of its coordinates.
Wide randomSurfacePoint(const builder::TriangleMesh& mesh, std::mt19937_64& engine);

}  // namespace cairn::hard
