// SPDX-License-Identifier: Zlib
#include "kernel/overlap_patches.h"

#include <algorithm>

namespace cairn::bullet {

void OverlapPatches::Side::begin(const PlacedSurface& surface) {
  for (const std::uint32_t patch : patches_) isNamed_[patch] = false;
  patches_.clear();
  surface_ = &surface;
  if (isNamed_.size() < surface.patches().count()) isNamed_.resize(surface.patches().count());
}

void OverlapPatches::Side::addEdge(std::uint32_t edge) {
  add(surface_->patches().ownersOfEdges()[edge]);
  for (const std::uint32_t t : surface_->features().edges()[edge].triangle)
    if (t != SurfaceEdge::kNone) addFace(t);
}

void OverlapPatches::Side::addVertex(std::uint32_t vertex) {
  add(surface_->patches().ownersOfVertices()[vertex]);
  for (const std::uint32_t edge : surface_->features().edgesAround(vertex)) addEdge(edge);
}

std::span<const std::uint32_t> OverlapPatches::Side::all() {
  std::ranges::sort(patches_);
  return patches_;
}

std::span<const PatchPair> OverlapPatches::pairsOf(const SurfacePair& surfaces,
                                                   std::span<const OverlapRegion> regions) {
  a_.begin(surfaces.a);
  b_.begin(surfaces.b);
  for (const OverlapRegion& region : regions)
    for (const OverlapPoint& point : region.points) {
      Side &own = point.isOfA ? a_ : b_, &other = point.isOfA ? b_ : a_;
      if (point.isCrossing) {
        own.addEdge(point.feature);
        other.addFace(point.face);
      } else {
        own.addVertex(point.feature);
      }
    }
  pairs_.clear();
  for (const std::uint32_t a : a_.all())
    for (const std::uint32_t b : b_.all()) pairs_.push_back({a, b});
  return pairs_;
}

}  // namespace cairn::bullet
