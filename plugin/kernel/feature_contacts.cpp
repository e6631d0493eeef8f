// SPDX-License-Identifier: Zlib
#include "kernel/feature_contacts.h"

#include <algorithm>

#include "kernel/contact_tuning.h"

namespace cairn::bullet {

bool isOver(const SurfaceFace& face, const PlacedSurface& faced, std::uint32_t index, const Vec3& p, float beside) {
  bool isInside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const float inside = dot(face.inward[k], p) - face.inwardOffset[k];
    if (inside < -beside) return false;
    isInside = isInside && inside >= 0;
  }
  if (isInside) return true;
  const auto& corners = faced.mesh.triangles[index];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& from = faced.vertex(corners[k]);
    const Vec3 side = faced.vertex(corners[(k + 1) % 3]) - from, to = p - from;
    const Vec3 off = to - side * std::clamp(dot(to, side) / lengthSq(side), 0.0F, 1.0F);
    const float height = dot(face.normal, off);
    if (lengthSq(off) - height * height <= beside * beside) return true;
  }
  return false;
}

namespace {

// The nearest points of two lines, as fractions of their vectors.
struct Nearest {
  float alongA = 0, alongB = 0;
};

struct Line {
  Vec3 from, way;
};

// Precondition: not parallel.
Nearest nearestOf(const Line& a, const Line& b) {
  const Vec3 between = a.from - b.from;
  const float aa = lengthSq(a.way), bb = lengthSq(b.way), ab = dot(a.way, b.way);
  const float da = dot(a.way, between), db = dot(b.way, between);
  const float det = aa * bb - ab * ab;
  return {(ab * db - bb * da) / det, (aa * db - ab * da) / det};
}

bool isWithin(float along, float length, float beside) {
  return along * length >= -beside && (along - 1) * length <= beside;
}

}  // namespace

void FeatureContacts::append(const FeatureSpans& lists, float moved, std::vector<FeatureContact>& contacts) const {
  FeatureSpans::forEachAt(moved, lists.verticesOnFaces, [&](std::uint32_t vertex, std::uint32_t face) {
    appendVertexFace(surfaces_.a, surfaces_.b, vertex, face, contacts);
  });
  FeatureSpans::forEachAt(moved, lists.facesOnVertices, [&](std::uint32_t face, std::uint32_t vertex) {
    appendVertexFace(surfaces_.b, surfaces_.a, vertex, face, contacts);
  });
  FeatureSpans::forEachAt(moved, lists.edgesOnEdges,
                          [&](std::uint32_t ofA, std::uint32_t ofB) { appendEdgeEdge(ofA, ofB, contacts); });
}

// Whether the vertex is in its cone: a neighbour nearer to the other surface would touch in its place. `towards`: unit,
// own frame, from the vertex to the other surface.
bool FeatureContacts::isVertexAlong(const PlacedSurface& side, std::uint32_t vertex, const Vec3& towards,
                                    float separation) const {
  const SurfaceFeatures& features = side.features();
  const Vec3& here = side.vertex(vertex);
  for (const std::uint32_t edge : features.edgesAround(vertex)) {
    const Vec3 toNeighbour = side.vertex(features.across(edge, vertex)) - here;
    if (dot(towards, toNeighbour) * side.scale > limits_.belowAt(separation, length(toNeighbour) * side.scale))
      return false;
  }
  return true;
}

void FeatureContacts::appendVertexFace(const PlacedSurface& pointed, const PlacedSurface& faced, std::uint32_t vertex,
                                       std::uint32_t index, std::vector<FeatureContact>& contacts) const {
  const bool isOfA = &pointed == &surfaces_.a;
  const SurfaceFace& face = faced.features().faces()[index];
  const Vec3 placed = (isOfA ? placed_.aInB : placed_.bInA)[vertex];
  const float height = dot(face.normal, placed) - face.offset;
  const float separation = height * faced.scale - limits_.margins;
  if (!limits_.trusts(separation) || !isOver(face, faced, index, placed, limits_.besideAt(separation) / faced.scale))
    return;
  if (!isVertexAlong(pointed, vertex, -(faced.axesToOther * face.normal), separation)) return;
  const Vec3 normal = faced.directionToPair(face.normal);
  FeatureContact contact;
  contact.position = faced.toPair * (placed - face.normal * (0.5F * height));
  contact.normal = isOfA ? normal : -normal;
  contact.separation = separation;
  contact.kind = isOfA ? FeatureKind::vertexOnFace : FeatureKind::faceOnVertex;
  contact.featureA = isOfA ? vertex : index;
  contact.featureB = isOfA ? index : vertex;
  contacts.push_back(contact);
}

// Whether the edge is in its cone, judged by the far corners of its two faces. Arguments as in `isVertexAlong`.
bool FeatureContacts::isEdgeAlong(const PlacedSurface& side, const SurfaceEdge& edge, const Vec3& towards,
                                  float separation) const {
  const Vec3& here = side.vertex(edge.vertex[0]);
  const Vec3 along = side.vertex(edge.vertex[1]) - here;
  for (const std::uint32_t v : edge.opposite) {
    if (v == SurfaceEdge::kNone) continue;
    const Vec3 toCorner = side.vertex(v) - here;
    const Vec3 beside = toCorner - along * (dot(toCorner, along) / lengthSq(along));
    if (dot(towards, toCorner) * side.scale > limits_.belowAt(separation, length(beside) * side.scale)) return false;
  }
  return true;
}

// Computes in B's frame.
void FeatureContacts::appendEdgeEdge(std::uint32_t ofA, std::uint32_t ofB,
                                     std::vector<FeatureContact>& contacts) const {
  const PlacedSurface &a = surfaces_.a, &b = surfaces_.b;
  const SurfaceEdge &edgeA = a.features().edges()[ofA], &edgeB = b.features().edges()[ofB];
  const auto line = [](const Vec3& from, const Vec3& to) { return Line{from, to - from}; };
  const Line lineA = line(placed_.aInB[edgeA.vertex[0]], placed_.aInB[edgeA.vertex[1]]);
  const Line lineB = line(b.vertex(edgeB.vertex[0]), b.vertex(edgeB.vertex[1]));
  const Vec3 outwardA = a.axesToOther * edgeA.outward, across = cross(lineA.way, lineB.way);
  const float alongB = dot(across, edgeB.outward);
  if (!(alongB * dot(across, outwardA) < 0)) return;
  const float lengthA = length(lineA.way), lengthB = length(lineB.way), norm = length(across);
  if (!(norm > tuning::kParallelSine * lengthA * lengthB)) return;
  const Vec3 normal = across * ((alongB < 0 ? -1 : 1) / norm);
  const float separation = dot(normal, lineA.from - lineB.from) * b.scale - limits_.margins;
  if (!limits_.trusts(separation)) return;
  const Nearest at = nearestOf(lineA, lineB);
  const float beside = limits_.besideAt(separation) / b.scale;
  if (!isWithin(at.alongA, lengthA, beside) || !isWithin(at.alongB, lengthB, beside)) return;
  if (!isEdgeAlong(b, edgeB, normal, separation)) return;
  if (!isEdgeAlong(a, edgeA, -(b.axesToOther * normal), separation)) return;
  FeatureContact contact;
  contact.position = b.toPair * ((lineA.from + lineA.way * at.alongA + lineB.from + lineB.way * at.alongB) * 0.5F);
  contact.normal = b.directionToPair(normal);
  contact.separation = separation;
  contact.kind = FeatureKind::edgeOnEdge;
  contact.featureA = ofA;
  contact.featureB = ofB;
  contacts.push_back(contact);
}

}  // namespace cairn::bullet
