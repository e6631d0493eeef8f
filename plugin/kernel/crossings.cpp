// SPDX-License-Identifier: Zlib
#include "kernel/crossings.h"

namespace cairn::bullet {

namespace {

// Precondition: the edge crosses the face's plane, from `from` to `to`, both in the faces' frame.
Crossing crossingOf(const PlacedSurface& faced, std::uint32_t face, const Vec3& from, const Vec3& to) {
  const SurfaceFace& plane = faced.features().faces()[face];
  const float first = dot(plane.normal, from) - plane.offset, second = dot(plane.normal, to) - plane.offset;
  Crossing crossing;
  crossing.along = first / (first - second);
  crossing.position = faced.toPair * (from + (to - from) * crossing.along);
  crossing.face = face;
  crossing.enters = second < 0;
  return crossing;
}

}  // namespace

void appendCrossings(const SurfacePair& surfaces, const PatchPair& patches,
                     std::vector<Crossing>& crossings) {
  const auto append = [&](Crossing crossing, std::uint32_t edge, bool isEdgeOfA) {
    crossing.edge = edge;
    crossing.isEdgeOfA = isEdgeOfA;
    crossings.push_back(crossing);
  };
  for (const auto& [edge, face] : patches.edgesThroughFaces.all()) {
    const auto [from, to] = patches.a.edgeEnds[edge];
    append(crossingOf(surfaces.b, patches.b.triangles[face], patches.aInB[from], patches.aInB[to]),
           patches.a.edges[edge], true);
  }
  for (const auto& [face, edge] : patches.facesThroughEdges.all()) {
    const auto [from, to] = patches.b.edgeEnds[edge];
    append(crossingOf(surfaces.a, patches.a.triangles[face], patches.bInA[from], patches.bInA[to]),
           patches.b.edges[edge], false);
  }
}

}  // namespace cairn::bullet
