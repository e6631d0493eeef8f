// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "kernel/placed_surface.h"
#include "memory/stamped_list.h"

namespace cairn::bullet {

/// A surface's vertices in the other's frame, each put there when it is first asked for: edges share their ends.
class PlacedVertices {
 public:
  /// Forgets the last surface. `side` must outlive the questions.
  void begin(const PlacedSurface& side) {
    side_ = &side;
    places_.begin(side.mesh.vertices.size());
  }
  const Vec3& operator[](std::uint32_t index) {
    return places_.get(index, [&] { return side_->toOther * side_->vertex(index); });
  }

 private:
  const PlacedSurface* side_ = nullptr;
  StampedList<Vec3> places_;
};

/// Both surfaces of a pair.
struct PlacedPair {
  PlacedVertices aInB, bInA;

  void begin(const SurfacePair& surfaces) {
    aInB.begin(surfaces.a);
    bInA.begin(surfaces.b);
  }
};

}  // namespace cairn::bullet
