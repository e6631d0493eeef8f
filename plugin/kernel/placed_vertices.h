// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/placed_surface.h"

namespace cairn::bullet {

/// A surface's vertices in the other's frame, each put there when it is first asked for: edges share their ends.
class PlacedVertices {
 public:
  /// Forgets the last surface. `side` must outlive the questions.
  void begin(const PlacedSurface& side) {
    side_ = &side;
    if (vertices_.size() < side.mesh.vertices.size()) vertices_.resize(side.mesh.vertices.size());
    if (++run_ == 0) {  // all stamps are old
      vertices_.assign(vertices_.size(), {});
      run_ = 1;
    }
  }
  const Vec3& operator[](std::uint32_t index) {
    Vertex& vertex = vertices_[index];
    if (vertex.run != run_) vertex = {side_->toOther * side_->vertex(index), run_};
    return vertex.place;
  }

 private:
  struct Vertex {
    Vec3 place;
    std::uint32_t run = 0;
  };
  const PlacedSurface* side_ = nullptr;
  std::vector<Vertex> vertices_;
  std::uint32_t run_ = 0;
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
