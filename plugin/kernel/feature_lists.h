// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::bullet {

/// The lists that a caller needs.
enum class Asked : std::uint8_t {
  all,
  touching  ///< without crossings
};

/// A feature of A and a feature of B, by the meshes' own indices. They neither touch nor cross until some point of one
/// body has moved by `margin` against the other. That is a world length; it is not positive where they may touch now.
struct FeaturePair {
  std::uint32_t a = 0, b = 0;
  float margin = 0;

  bool operator==(const FeaturePair&) const = default;
};

/// The pairs of features of two surfaces that may touch, by kind.
struct FeatureLists {
  using List = std::vector<FeaturePair>;

  List verticesOnFaces, facesOnVertices;
  List edgesOnEdges;  ///< convex edges only
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

/// The same lists as spans, whoever stores them. Valid as long as the storage.
struct FeatureSpans {
  using List = std::span<const FeaturePair>;

  List verticesOnFaces, facesOnVertices, edgesOnEdges, edgesThroughFaces, facesThroughEdges;

  FeatureSpans() = default;

  FeatureSpans(const FeatureLists& lists)
      : verticesOnFaces(lists.verticesOnFaces),
        facesOnVertices(lists.facesOnVertices),
        edgesOnEdges(lists.edgesOnEdges),
        edgesThroughFaces(lists.edgesThroughFaces),
        facesThroughEdges(lists.facesThroughEdges) {}

  std::array<List*, 5> all() {
    return {&verticesOnFaces, &facesOnVertices, &edgesOnEdges, &edgesThroughFaces, &facesThroughEdges};
  }
  /// Calls `ask(a, b)` for each pair that may touch after a displacement of `moved`, a world length, since the listing.
  template <class Ask>
  static void forEachAt(float moved, List list, const Ask& ask) {
    for (const FeaturePair& pair : list)
      if (pair.margin <= moved) ask(pair.a, pair.b);
  }
};

/// Lists kept from step to step, in one block hardly larger than their contents.
class CachedFeatures {
 public:
  /// Copies the lists. Cost: linear in them; allocates only when they are longer than all before.
  void keep(FeatureSpans lists) {
    std::size_t size = 0;
    for (const auto* list : lists.all()) size += list->size();
    pairs_.clear();
    // The spare room lets lists vary a little without an allocation.
    if (size > pairs_.capacity()) pairs_.reserve(size + size / 4);
    for (std::size_t i = 0; const auto* list : lists.all()) {
      pairs_.insert(pairs_.end(), list->begin(), list->end());
      ends_[i++] = static_cast<std::uint32_t>(pairs_.size());
    }
  }
  /// The lists kept last. Valid until the next `keep`.
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
  /// Capacity, in pairs.
  std::size_t room() const { return pairs_.capacity(); }

 private:
  std::vector<FeaturePair> pairs_;
  std::array<std::uint32_t, 5> ends_{};  // of each list
};

}  // namespace cairn::bullet
