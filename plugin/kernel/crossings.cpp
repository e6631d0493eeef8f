// SPDX-License-Identifier: Zlib
#include "kernel/crossings.h"

namespace cairn::bullet {

namespace {

void append(const PlacedSurface& edged, PlacedVertices& placed, const PlacedSurface& faced, std::uint32_t edge,
            std::uint32_t index, bool isEdgeOfA, std::vector<Crossing>& crossings) {
  const SurfaceFace& face = faced.features().faces()[index];
  const auto& [v, w] = edged.features().edges()[edge].vertex;
  const Vec3 from = placed[v], to = placed[w];
  const float first = dot(face.normal, from) - face.offset, second = dot(face.normal, to) - face.offset;
  if ((first < 0) == (second < 0)) return;
  const float along = first / (first - second);
  const Vec3 place = from + (to - from) * along;
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(face.inward[k], place) < face.inwardOffset[k]) return;
  crossings.push_back({faced.toPair * place, along, edge, index, isEdgeOfA, second < 0});
}

}  // namespace

void appendCrossings(const SurfacePair& surfaces, PlacedPair& placed, const FeatureSpans& lists, float moved,
                     std::vector<Crossing>& crossings) {
  FeatureSpans::forEachAt(moved, lists.edgesThroughFaces, [&](std::uint32_t edge, std::uint32_t face) {
    append(surfaces.a, placed.aInB, surfaces.b, edge, face, true, crossings);
  });
  FeatureSpans::forEachAt(moved, lists.facesThroughEdges, [&](std::uint32_t face, std::uint32_t edge) {
    append(surfaces.b, placed.bInA, surfaces.a, edge, face, false, crossings);
  });
}

}  // namespace cairn::bullet
