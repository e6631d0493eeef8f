// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/tree_surface.h"
#include "placement/placed_tree.h"

namespace cairn::bullet {

/// One of the two surfaces of a pair, with the maps from its own frame and unit (its mesh's) to the pair's and the
/// other's.
///
///     const SurfacePair surfaces = SurfacePair::of(treeA, treeB);
///     const Vec3 inPair = surfaces.a.toPair * surfaces.a.vertex(i);
struct PlacedSurface {
  SurfaceView mesh;
  Similarity toPair;
  Similarity toOther;
  Mat3 axesFromPair, axesToOther;  ///< rotations without scale
  float scale = 1;                 ///< world length of the mesh's unit

  /// For callers that do not use the other surface's frame.
  static PlacedSurface of(const SurfaceView& mesh, const Pose& pose);

  const SurfacePatches& patches() const { return mesh.patches(); }
  const SurfaceFeatures& features() const { return mesh.features(); }
  const Vec3& vertex(std::uint32_t index) const { return mesh.vertices[index]; }
  /// A point of the pair frame in the surface's own frame and unit.
  Vec3 fromPair(const Vec3& p) const { return axesFromPair * (p - toPair.translation) * (1 / scale); }
  /// A unit vector of the surface's own frame in the pair frame.
  Vec3 directionToPair(const Vec3& unit) const { return toPair.linear * unit * (1 / scale); }
};

/// Both surfaces of a pair. Precondition: the meshes outlive it.
struct SurfacePair {
  PlacedSurface a, b;

  /// Places two meshes by their poses in the pair frame.
  static SurfacePair of(const SurfaceView& a, const Pose& poseOfA, const SurfaceView& b, const Pose& poseOfB);
  static SurfacePair of(const PlacedTree& a, const PlacedTree& b) {
    return of(a.contactMesh(), a.pose(), b.contactMesh(), b.pose());
  }
};

}  // namespace cairn::bullet
