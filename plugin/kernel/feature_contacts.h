// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/contact_limits.h"
#include "kernel/feature_lists.h"
#include "kernel/placed_vertices.h"

namespace cairn::bullet {

/// The kinds of features in contact, A's first. The deep kinds belong to overlap too deep for a local minimum: a point
/// of one body inside the other.
enum class FeatureKind : std::uint8_t {
  vertexOnFace,
  faceOnVertex,
  edgeOnEdge,
  deepVertexOfA,
  deepVertexOfB,
  deepEdgeOfA,  ///< where it crosses a face of B
  deepEdgeOfB,
};

constexpr bool isDeep(FeatureKind kind) {
  return kind > FeatureKind::edgeOnEdge;
}

/// A local minimum of the distance between two surfaces; pair frame, world lengths.
struct FeatureContact {
  Vec3 position;         ///< half-way between the surfaces
  Vec3 normal;           ///< unit, from B to A
  float separation = 0;  ///< along the normal, negative where the surfaces overlap
  FeatureKind kind = FeatureKind::vertexOnFace;
  std::uint32_t featureA = 0, featureB = 0;  ///< indices of the mesh; unused for the other body of a deep vertex
};

/// Depth of the deepest of these contacts; 0 where nothing overlaps.
inline float deepestOf(std::span<const FeatureContact> contacts) {
  float deepest = 0;
  for (const FeatureContact& c : contacts) deepest = std::max(deepest, -c.separation);
  return deepest;
}

/// Whether a point (the surface's own frame and unit) is over a face, or at most `beside` from its sides. The distance
/// to the sides themselves counts, because past a sharp corner a point can be near two sides' lines and far away.
bool isOver(const SurfaceFace& face, const PlacedSurface& faced, std::uint32_t index, const Vec3& p, float beside);

/// Decides which pairs of features are contacts: vertices on faces, both ways, and edges on edges. Cost: constant per
/// pair.
///
///     FeatureContacts(surfaces, placed, limits).append(lists, moved, contacts);
class FeatureContacts {
 public:
  FeatureContacts(const SurfacePair& surfaces, PlacedPair& placed, const ContactLimits& limits)
      : surfaces_(surfaces), placed_(placed), limits_(limits) {}

  /// `moved`: bound on the bodies' displacement since the features were listed, world length.
  void append(const FeatureSpans& lists, float moved, std::vector<FeatureContact>& contacts) const;

 private:
  void appendVertexFace(const PlacedSurface& pointed, const PlacedSurface& faced, std::uint32_t vertex,
                        std::uint32_t face, std::vector<FeatureContact>& contacts) const;
  bool isVertexAlong(const PlacedSurface& side, std::uint32_t vertex, const Vec3& towards, float separation) const;
  void appendEdgeEdge(std::uint32_t ofA, std::uint32_t ofB, std::vector<FeatureContact>& contacts) const;
  bool isEdgeAlong(const PlacedSurface& side, const SurfaceEdge& edge, const Vec3& towards, float separation) const;

  const SurfacePair& surfaces_;
  PlacedPair& placed_;
  const ContactLimits& limits_;
};

}  // namespace cairn::bullet
