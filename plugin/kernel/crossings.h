// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// A point where an edge of one surface passes through a face of the other. Crossings find regions of overlap
/// (`OverlapRegions`).
struct Crossing {
  Vec3 position;    ///< pair frame
  float along = 0;  ///< along the edge, from 0 at its first vertex to 1 at its second
  std::uint32_t edge = 0, face = 0;
  bool isEdgeOfA = false;  ///< the edge belongs to A and the face to B, or the other way round
  bool enters = false;     ///< the edge's second vertex is on the inner side of the face

  auto place() const { return std::tuple(isEdgeOfA, edge, along, face); }
};

/// Appends all crossings among the listed features. `moved`: bound on the displacement since the features were listed,
/// world length.
void appendCrossings(const SurfacePair& surfaces, PlacedPair& placed, const FeatureSpans& lists, float moved,
                     std::vector<Crossing>& crossings);

}  // namespace cairn::bullet
