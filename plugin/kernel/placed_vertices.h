// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>

#include "kernel/placed_surface.h"
#include "memory/stamped_list.h"

namespace cairn::bullet {

/// A surface's vertices in the other's frame, each transformed once, when first needed: edges share their ends.
class PlacedVertices {
 public:
  /// Starts a new surface. `side` must outlive the following calls.
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

/// The vertices of both surfaces of a pair.
struct PlacedPair {
  PlacedVertices aInB, bInA;

  void begin(const SurfacePair& surfaces) {
    aInB.begin(surfaces.a);
    bInA.begin(surfaces.b);
  }
};

}  // namespace cairn::bullet
