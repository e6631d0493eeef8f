// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "balls/piece.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::builder {

/// The outward unit normal of a source triangle, and the area of the region on it.
struct FacingArea {
  Vec3d normal;
  double area = 0;
};
std::vector<FacingArea> facingAreas(std::span<const Piece> pieces, const TriangleMesh& mesh);

/// Returns up to `kMaxFaceNormals` directions that most of the region faces, by area, largest first. Each is the mean
/// normal of the area within a few degrees of it. A planar region gets its own normal, exactly up to rounding; a round
/// one gets its mean direction.
std::vector<Vec3> dominantNormals(std::span<const FacingArea> areas);

/// Returns the smallest cone that holds all normals, rounded outward. It is the whole sphere when they span a half
/// space or more.
NormalCone normalConeOf(std::span<const FacingArea> areas);

}  // namespace cairn::builder
