// SPDX-License-Identifier: Zlib
#include "kernel/feature_lists.h"

#include <algorithm>
#include <limits>
#include <span>

namespace cairn::bullet {

namespace {

using Places = std::span<const std::uint32_t>;

void append(const FeaturePairs& found, Places ofA, Places ofB, FeatureLists::List& list) {
  for (const auto& [a, b] : found.all()) list.push_back({ofA[a], ofB[b]});
}

// Patches share their borders' vertices and edges.
void makeUnique(FeatureLists::List& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

void FeatureLists::clear() {
  for (List* list : {&verticesOnFaces, &facesOnVertices, &edgesOnEdges, &edgesThroughFaces, &facesThroughEdges})
    list->clear();
}

bool FeatureLister::list(const SurfacePair& surfaces, const ContactLimits& limits, FeatureLists& lists,
                         Budget& budget) {
  lists.clear();
  const SurfacePatches &ofA = surfaces.a.surface().patches, &ofB = surfaces.b.surface().patches;
  if (!nearPatches_.find(surfaces, limits, budget)) return false;
  const std::span<const NearPatches::Pair> near = nearPatches_.found();
  if (!budget.charge(kOverlapTestCost * near.size())) return false;
  for (const NearPatches::Pair& pair : near) {
    patches_.a = ofA.patch(pair.a);
    patches_.b = ofB.patch(pair.b);
    testPatches(surfaces, limits, patches_);
    append(lists);
  }
  for (FeatureLists::List* list : {&lists.verticesOnFaces, &lists.facesOnVertices, &lists.edgesOnEdges,
                                   &lists.edgesThroughFaces, &lists.facesThroughEdges})
    makeUnique(*list);
  lists.apart = near.empty() ? nearPatches_.apart() : -std::numeric_limits<float>::infinity();
  return true;
}

std::size_t FeatureLists::size() const {
  return verticesOnFaces.size() + facesOnVertices.size() + edgesOnEdges.size() + edgesThroughFaces.size() +
         facesThroughEdges.size();
}

void FeatureLister::append(FeatureLists& lists) const {
  const SurfacePatch &a = patches_.a, &b = patches_.b;
  bullet::append(patches_.verticesOnFaces, a.vertices, b.triangles, lists.verticesOnFaces);
  bullet::append(patches_.facesOnVertices, a.triangles, b.vertices, lists.facesOnVertices);
  bullet::append(patches_.edgesOnEdges, a.edges, b.edges, lists.edgesOnEdges);
  bullet::append(patches_.edgesThroughFaces, a.edges, b.triangles, lists.edgesThroughFaces);
  bullet::append(patches_.facesThroughEdges, a.triangles, b.edges, lists.facesThroughEdges);
}

}  // namespace cairn::bullet
