// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn::bullet {

/// Which of their lists are asked for.
enum class Asked : std::uint8_t {
  all,
  touching  ///< without what crosses
};

/// Pairs of features of two surfaces that may touch: A's first. Indices are the meshes' own.
struct FeatureLists {
  using List = std::vector<std::array<std::uint32_t, 2>>;

  List verticesOnFaces, facesOnVertices;
  List edgesOnEdges;  ///< convex ones
  List edgesThroughFaces, facesThroughEdges;

  void clear() {
    for (List* list : {&verticesOnFaces, &facesOnVertices, &edgesOnEdges, &edgesThroughFaces, &facesThroughEdges})
      list->clear();
  }
  std::size_t size() const {
    return verticesOnFaces.size() + facesOnVertices.size() + edgesOnEdges.size() + edgesThroughFaces.size() +
           facesThroughEdges.size();
  }
};

}  // namespace cairn::bullet
