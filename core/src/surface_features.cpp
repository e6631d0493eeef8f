// SPDX-License-Identifier: Zlib
#include "cairn/core/surface_features.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace cairn {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// An edge bends if its faces' normals are more than 0.01 rad apart: below that a mesh's rounding bends flat faces.
constexpr float kBendSine = 0.01F;

// One side of a triangle, its vertices ascending.
struct HalfEdge {
  std::uint32_t low, high;
  std::uint32_t triangle, side;

  auto key() const { return std::tuple(low, high, triangle, side); }
};

std::vector<HalfEdge> halfEdgesOf(std::span<const Triangle> triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t v = triangles[t][side], w = triangles[t][(side + 1) % 3];
      halves.push_back({std::min(v, w), std::max(v, w), t, side});
    }
  std::ranges::sort(halves, {}, &HalfEdge::key);
  return halves;
}

Vec3 unitOrZero(const Vec3& v) {
  const float norm = length(v);
  return norm > 0 && std::isfinite(norm) ? v / norm : Vec3();
}

}  // namespace

SurfaceFeatures::SurfaceFeatures(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  makeFaces(vertices, triangles);
  makeEdges(vertices, triangles);
  makeStars(vertices.size());
}

// In doubles: a sliver's normal is a difference of large products.
void SurfaceFeatures::makeFaces(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  faces_.assign(triangles.size(), {});
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<Vec3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = Vec3d(vertices[triangles[t][k]]);
    const Vec3d area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double norm = length(area);
    if (!(norm > 0)) continue;
    SurfaceFace& face = faces_[t];
    const Vec3d normal = area / norm;
    face.normal = Vec3(normal);
    face.offset = static_cast<float>(dot(normal, corner[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d inward = normalized(cross(normal, corner[(k + 1) % 3] - corner[k]));
      face.inward[k] = Vec3(inward);
      face.inwardOffset[k] = static_cast<float>(dot(inward, corner[k]));
    }
  }
}

void SurfaceFeatures::makeEdges(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  const std::vector<HalfEdge> halves = halfEdgesOf(triangles);
  edgesOf_.resize(triangles.size());
  edges_.reserve(halves.size() / 2);
  for (std::size_t i = 0; i < halves.size();) {
    const bool isPair =
        i + 1 < halves.size() && halves[i].low == halves[i + 1].low && halves[i].high == halves[i + 1].high;
    SurfaceEdge edge;
    edge.vertex = {halves[i].low, halves[i].high};
    for (std::size_t k = 0; k < (isPair ? 2U : 1U); ++k) {
      const HalfEdge& half = halves[i + k];
      edge.triangle[k] = half.triangle;
      edge.opposite[k] = triangles[half.triangle][(half.side + 2) % 3];
      edgesOf_[half.triangle][half.side] = static_cast<std::uint32_t>(edges_.size());
    }
    bendEdge(edge, vertices);
    edges_.push_back(edge);
    i += isPair ? 2 : 1;
  }
}

void SurfaceFeatures::bendEdge(SurfaceEdge& edge, std::span<const Vec3> vertices) {
  const bool isPair = edge.triangle[1] != SurfaceEdge::kNone;
  Vec3 sum;
  sum += faces_[edge.triangle[0]].normal;
  if (isPair) sum += faces_[edge.triangle[1]].normal;
  edge.outward = unitOrZero(sum);
  edge.isConvex = true;
  bool isHollow = !isPair;
  if (isPair) {
    // Each face's plane sees the other's far corner below it, by the sine of the bend.
    const Vec3 &n = faces_[edge.triangle[0]].normal, &m = faces_[edge.triangle[1]].normal;
    const Vec3 along = vertices[edge.opposite[1]] - vertices[edge.vertex[0]];
    const bool isBent = length(cross(n, m)) > kBendSine;
    edge.isConvex = isBent && dot(n, along) < 0;
    isHollow = isBent && dot(n, along) > 0;
  }
  hasHollows_ = hasHollows_ || isHollow;
}

void SurfaceFeatures::follow(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  makeFaces(vertices, triangles);
  hasHollows_ = false;
  for (SurfaceEdge& edge : edges_) bendEdge(edge, vertices);
}

void SurfaceFeatures::makeStars(std::size_t vertexCount) {
  firstOfStar_.assign(vertexCount + 1, 0);
  for (const SurfaceEdge& edge : edges_)
    for (const std::uint32_t v : edge.vertex) ++firstOfStar_[v + 1];
  for (std::size_t v = 0; v < vertexCount; ++v) firstOfStar_[v + 1] += firstOfStar_[v];
  star_.resize(firstOfStar_[vertexCount]);
  std::vector<std::uint32_t> next(firstOfStar_.begin(), firstOfStar_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    for (const std::uint32_t v : edges_[e].vertex) star_[next[v]++] = e;
}

std::size_t SurfaceFeatures::memoryBytes() const {
  return edges_.capacity() * sizeof(SurfaceEdge) + faces_.capacity() * sizeof(SurfaceFace) +
         edgesOf_.capacity() * sizeof(edgesOf_[0]) +
         (star_.capacity() + firstOfStar_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace cairn
