// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/vec3.h"

namespace cairn {

/// Two triangles of a surface that share two vertices. Indices are those of the mesh.
struct SurfaceEdge {
  /// Stands for a triangle or vertex that is not there.
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::array<std::uint32_t, 2> vertex{};                ///< its two ends
  std::array<std::uint32_t, 2> triangle{kNone, kNone};  ///< the second is `kNone` at a border of an open surface
  std::array<std::uint32_t, 2> opposite{kNone, kNone};  ///< of each triangle the vertex that is not on the edge
  Vec3 outward;           ///< unit, the mean of the triangles' normals; zero where these cancel
  bool isConvex = false;  ///< the surface bends away from `outward` here by more than 0.01 rad, or ends
};

/// A triangle's plane and the planes through its sides, each with its unit normal: `dot(normal, p) - offset`.
struct SurfaceFace {
  Vec3 normal;                          ///< outward; zero for a triangle without area, which touches nothing
  float offset = 0;                     ///< of the plane, along `normal`
  std::array<Vec3, 3> inward;           ///< in the triangle's plane, from side k (corners k, k + 1) to the triangle
  std::array<float, 3> inwardOffset{};  ///< of the planes through the sides, along `inward`
};

/// How the triangles of a mesh hang together: what a contact needs to know of the surface around a vertex or an edge.
/// Derived from the mesh alone, in time n log n; immutable. Lengths and frame are the mesh's. Works for open surfaces
/// and for edges of more than two triangles, which are paired in the order of the file.
class CAIRN_CORE_EXPORT SurfaceFeatures {
 public:
  SurfaceFeatures() = default;
  /// Precondition: indices are below `vertices.size()`. The mesh is not kept.
  SurfaceFeatures(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);

  /// All edges; their numbers are places in this list.
  std::span<const SurfaceEdge> edges() const { return edges_; }
  /// One for each triangle of the mesh, in its order.
  std::span<const SurfaceFace> faces() const { return faces_; }
  /// Of triangle t, the edge between its corners k and k + 1 in `edgesOf()[t][k]`.
  std::span<const std::array<std::uint32_t, 3>> edgesOf() const { return edgesOf_; }
  /// The edges that meet in a vertex, ascending.
  std::span<const std::uint32_t> edgesAround(std::uint32_t vertex) const {
    return std::span(star_).subspan(firstOfStar_[vertex], firstOfStar_[vertex + 1] - firstOfStar_[vertex]);
  }
  /// The other end of an edge.
  std::uint32_t across(std::uint32_t edge, std::uint32_t vertex) const {
    const SurfaceEdge& e = edges_[edge];
    return e.vertex[0] == vertex ? e.vertex[1] : e.vertex[0];
  }
  /// Whether something may hang in the surface: an edge bends inwards by more than 0.01 rad, or there is a border.
  bool hasHollows() const { return hasHollows_; }
  /// Bytes of memory held.
  std::size_t memoryBytes() const;

 private:
  friend class TreeRefit;
  /// The same as a new object of the same triangles, in linear time and without new memory.
  void follow(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);
  void makeFaces(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);
  void makeEdges(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);
  void bendEdge(SurfaceEdge& edge, std::span<const Vec3> vertices);
  void makeStars(std::size_t vertexCount);

  std::vector<SurfaceEdge> edges_;
  std::vector<SurfaceFace> faces_;
  std::vector<std::array<std::uint32_t, 3>> edgesOf_;
  std::vector<std::uint32_t> star_, firstOfStar_;
  bool hasHollows_ = false;
};

}  // namespace cairn
