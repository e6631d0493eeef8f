// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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
  std::size_t size() const {
    return verticesOnFaces.size() + facesOnVertices.size() + edgesOnEdges.size() + edgesThroughFaces.size() +
           facesThroughEdges.size();
  }
};

/// The same lists, wherever they stand. Valid as long as these.
struct FeatureSpans {
  using List = std::span<const FeaturePair>;

  List verticesOnFaces, facesOnVertices, edgesOnEdges, edgesThroughFaces, facesThroughEdges;

  FeatureSpans() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): what takes spans takes lists
  FeatureSpans(const FeatureLists& lists)
      : verticesOnFaces(lists.verticesOnFaces),
        facesOnVertices(lists.facesOnVertices),
        edgesOnEdges(lists.edgesOnEdges),
        edgesThroughFaces(lists.edgesThroughFaces),
        facesThroughEdges(lists.facesThroughEdges) {}

  std::array<List*, 5> all() {
    return {&verticesOnFaces, &facesOnVertices, &edgesOnEdges, &edgesThroughFaces, &facesThroughEdges};
  }
  /// Calls `ask(a, b)` for each pair that may touch once bodies have moved so far, a world length, since they were
  /// listed.
  template <class Ask>
  static void forEachAt(float moved, List list, const Ask& ask) {
    for (const FeaturePair& pair : list)
      if (pair.margin <= moved) ask(pair.a, pair.b);
  }
};

/// Lists that are kept from step to step, in one block hardly larger than they are.
class CachedFeatures {
 public:
  void keep(FeatureSpans lists) {
    std::size_t size = 0;
    for (const auto* list : lists.all()) size += list->size();
    pairs_.clear();
    // Lists that vary by a few allocate nothing.
    if (size > pairs_.capacity()) pairs_.reserve(size + size / 4);
    for (std::size_t i = 0; const auto* list : lists.all()) {
      pairs_.insert(pairs_.end(), list->begin(), list->end());
      ends_[i++] = static_cast<std::uint32_t>(pairs_.size());
    }
  }
  FeatureSpans spans() const {
    FeatureSpans lists;
    std::uint32_t from = 0;
    for (std::size_t i = 0; auto* list : lists.all()) {
      *list = FeatureSpans::List(pairs_).subspan(from, ends_[i] - from);
      from = ends_[i++];
    }
    return lists;
  }
  void shrinkToFit() { pairs_.shrink_to_fit(); }
  /// Pairs.
  std::size_t room() const { return pairs_.capacity(); }

 private:
  std::vector<FeaturePair> pairs_;
  std::array<std::uint32_t, 5> ends_{};  // of each list
};

}  // namespace cairn::bullet
