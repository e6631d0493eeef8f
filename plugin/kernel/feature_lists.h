// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn::bullet {

/// Which of their lists are asked for.
enum class Asked : std::uint8_t {
  all,
  touching  ///< without what crosses
};

/// Two features, of A and of B, by the meshes' own indices. They neither touch nor cross before some point of one body
/// has moved by the margin against the other: a world length, not positive where they may do so now.
struct FeaturePair {
  std::uint32_t a = 0, b = 0;
  float margin = 0;

  bool operator==(const FeaturePair&) const = default;
};

/// Pairs of features of two surfaces that may touch.
struct FeatureLists {
  using List = std::vector<FeaturePair>;

  List verticesOnFaces, facesOnVertices;
  List edgesOnEdges;  ///< convex ones
  List edgesThroughFaces, facesThroughEdges;

  void clear() {
    for (List* list : {&verticesOnFaces, &facesOnVertices, &edgesOnEdges, &edgesThroughFaces, &facesThroughEdges})
      list->clear();
  }
  /// Calls `ask(a, b)` for each pair that may touch once bodies have moved so far, a world length, since they were
  /// listed.
  template <class Ask>
  static void forEachAt(float moved, const List& list, const Ask& ask) {
    for (const FeaturePair& pair : list)
      if (pair.margin <= moved) ask(pair.a, pair.b);
  }
  std::size_t size() const {
    return verticesOnFaces.size() + facesOnVertices.size() + edgesOnEdges.size() + edgesThroughFaces.size() +
           facesThroughEdges.size();
  }
};

}  // namespace cairn::bullet
