// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "kernel/feature_contacts.h"

namespace cairn::bullet {

/// Where an edge of one surface goes through a face of the other.
struct Crossing {
  Vec3 position;    ///< pair frame
  float along = 0;  ///< of the edge, from 0 at its first vertex to 1 at its second
  std::uint32_t edge = 0, face = 0;
  bool isEdgeOfA = false;  ///< then the face is B's
  bool enters = false;     ///< the edge's second vertex is on the inner side of the face

  auto place() const { return std::tuple(isEdgeOfA, edge, along, face); }
};

/// Appends all crossings among what is listed. `moved`: as far as bodies may have moved, a world length, since.
void appendCrossings(const SurfacePair& surfaces, PlacedPair& placed, const FeatureSpans& lists, float moved,
                     std::vector<Crossing>& crossings);

}  // namespace cairn::bullet
