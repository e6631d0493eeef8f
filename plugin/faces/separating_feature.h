// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <span>

#include "faces/placed_mesh.h"

namespace cairn::bullet {

/// What gives a contact between two polyhedra its direction: a face of either, or an edge of each (Gottschalk's
/// separating axes). Kept in the bodies' own frames, it turns with them.
struct SeparatingFeature {
  Vec3 ofA, ofB;  ///< tree axes: a face's unit outward normal (the other is zero), or unit vectors along two edges

  /// Unit, pair frame, from B to A; zero where the edges are as good as parallel.
  Vec3 normal(const PlacedTree& a, const PlacedTree& b) const;
};

/// The feature whose direction is `normal` (unit, pair frame) within half a degree; faces before edges. Linear in the
/// triangles, times the edges of one another across the normal if no face has it. Precondition: `PlacedMesh::serves`
/// both trees.
std::optional<SeparatingFeature> featureAlong(const PlacedTree& a, const PlacedTree& b, const Vec3& normal);

/// Of two convex bodies, the feature along which they are farthest apart, or overlap least: `gap`, world length, whole
/// bodies. Faces are preferred to edges by a thousandth of the sizes, `lasts` (unit, pair frame) to others by
/// `lastBonus`, unless it `hasPreferences` no more.
struct Separation {
  SeparatingFeature feature;
  float gap = 0;
};
/// Cost: faces times vertices, and edges times edges times vertices unless a face separates by `enough` already, or
/// these are more than `kMaxEdgePairs`.
Separation bestSeparation(const PlacedTree& a, const PlacedTree& b, const PlacedMesh& meshA, const PlacedMesh& meshB,
                          std::span<const Vec3> lasts, float lastBonus, float enough, bool hasPreferences = true);
inline constexpr std::size_t kMaxEdgePairs = 400;

}  // namespace cairn::bullet
