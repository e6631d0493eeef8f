// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cairn/core/export.h"

#include "cairn/core/surface_features.h"

namespace cairn {

/// An axis-parallel box.
struct CAIRN_CORE_EXPORT Box {
  Vec3 lower, upper;  ///< opposite corners, in the frame of whoever holds the box

  /// Grows the box to hold a point.
  void add(const Vec3& p);
  /// The box with each side moved out by a length.
  Box grown(float by) const { return {lower - Vec3(by, by, by), upper + Vec3(by, by, by)}; }
  /// The centre.
  Vec3 middle() const { return (lower + upper) * 0.5F; }
  /// Whether a point lies inside or on the border.
  bool holds(const Vec3& p) const;
  /// Of the axes along which the boxes are apart, how far along the one where they are farthest; negative where they
  /// overlap.
  float separationTo(const Box& other) const {
    float separation = -std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      for (const float apart : {other.lower[axis] - upper[axis], lower[axis] - other.upper[axis]})
        if (separation < apart) separation = apart;
    return separation;
  }
};

/// A few triangles of a surface that lie together, with their vertices, and the edges and vertices that are this
/// patch's own: each of the surface is one patch's. Lists are indices of the mesh's features; rows of numbers hold one
/// column after the other, each padded to whole batches.
struct SurfacePatch {
  /// Numbers that one SIMD step takes.
  static constexpr std::uint32_t kBatch = 8;
  /// Triangles in a patch at most.
  static constexpr std::uint32_t kMaxTriangles = 8;
  static constexpr std::uint32_t kMaxFeatures = 3 * kMaxTriangles;  ///< vertices, and edges

  std::span<const std::uint32_t> vertices;   ///< of all its triangles
  std::span<const std::uint32_t> edges;      ///< its own
  std::span<const std::uint32_t> triangles;  ///< all of the patch
  std::uint32_t ownVertices = 0;             ///< so many of `vertices` are its own, the first ones
  std::uint32_t convexEdges = 0;             ///< so many of `edges` are convex, the first ones
  /// Of each edge, its ends by their places in `vertices`.
  std::span<const std::array<std::uint8_t, 2>> edgeEnds;
  const float* vertexColumns = nullptr;  ///< x, y, z; the last vertex is repeated
  const float* faceColumns = nullptr;    ///< normal and offset, then those of the three sides; what pads has no normal
  const float* edgeColumns = nullptr;    ///< of convex ones: first end, second end, outward; what pads has no length
  Box box;                               ///< of the vertices
  /// Of all directions in which the patch's faces, its own edges and vertices may be touched.
  Box normals;
  Vec3 facing;                    ///< unit, the mean of these; zero where they do not lie on one side
  float lowest = 0, highest = 0;  ///< of the vertices, along `facing`

  /// A count rounded up to whole batches.
  static constexpr std::uint32_t padded(std::size_t count) {
    return (static_cast<std::uint32_t>(count) + kBatch - 1) / kBatch * kBatch;
  }
};

/// Up to eight boxes side by side, each around a patch or around another such family; one number of each after the
/// other. Lanes that hold nothing overlap nothing.
struct alignas(32) PatchFamily {
  /// Boxes in a family.
  static constexpr std::uint32_t kWidth = SurfacePatch::kBatch;

  float lower[3][kWidth], upper[3][kWidth];              ///< corners of the boxes, by axis and lane
  float normalLower[3][kWidth], normalUpper[3][kWidth];  ///< as `SurfacePatch::normals`
  std::uint32_t child[kWidth];                           ///< the patch or the family
  std::uint32_t patches = 0;                             ///< a bit for each lane that is a patch

  /// Whether a lane's child is a patch, not a family.
  bool isPatch(std::uint32_t lane) const { return (patches >> lane & 1U) != 0; }
  /// The box of a lane.
  Box box(std::uint32_t lane) const {
    return {{lower[0][lane], lower[1][lane], lower[2][lane]}, {upper[0][lane], upper[1][lane], upper[2][lane]}};
  }
};

/// A surface cut into patches of at most `kMaxTriangles`, each triangle in one, and a tree of boxes above them.
/// Immutable.
class CAIRN_CORE_EXPORT SurfacePatches {
 public:
  SurfacePatches() = default;
  /// The mesh that the features are of. It is not kept.
  SurfacePatches(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
                 const SurfaceFeatures& features);

  /// How many patches there are.
  std::uint32_t count() const { return static_cast<std::uint32_t>(records_.size()); }
  /// Whose own the features of the mesh are, by index; a vertex of no triangle is nobody's (`SurfaceEdge::kNone`).
  std::span<const std::uint32_t> ownersOfVertices() const { return ofVertices_; }
  /// The patch that owns each edge of the mesh.
  std::span<const std::uint32_t> ownersOfEdges() const { return ofEdges_; }
  /// The patch that holds each triangle of the mesh.
  std::span<const std::uint32_t> ownersOfTriangles() const { return ofTriangles_; }
  /// A patch by its number. Valid as long as this lives. Constant time.
  SurfacePatch patch(std::uint32_t index) const;
  /// The first is the root's: of all of the surface.
  std::span<const PatchFamily> families() const { return families_; }
  /// Around all of the surface.
  const Box& box() const { return box_; }
  /// Bytes of memory held.
  std::size_t memoryBytes() const;

 private:
  friend class TreeRefit;
  /// Keeps the triangles of each patch and moves all else with the vertices, in linear time. The features are those of
  /// the moved mesh, with the same triangles as at first.
  void follow(std::span<const Vec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles,
              const SurfaceFeatures& features);
  struct Record {
    Box box, normals;
    Vec3 facing;
    float lowest = 0, highest = 0;
    std::uint32_t firstIndex = 0, firstEnd = 0, firstNumber = 0;
    std::uint16_t vertices = 0, ownVertices = 0, edges = 0, convexEdges = 0, triangles = 0;
  };
  class Maker;

  std::vector<PatchFamily> families_;
  Box box_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::array<std::uint8_t, 2>> ends_;
  std::vector<float> numbers_;
  std::vector<std::uint32_t> ofVertices_, ofEdges_, ofTriangles_;
};

inline SurfacePatch SurfacePatches::patch(std::uint32_t index) const {
  const Record& r = records_[index];
  const std::span<const std::uint32_t> lists(indices_);
  SurfacePatch patch;
  patch.vertices = lists.subspan(r.firstIndex, r.vertices);
  patch.edges = lists.subspan(r.firstIndex + r.vertices, r.edges);
  patch.triangles = lists.subspan(r.firstIndex + r.vertices + r.edges, r.triangles);
  patch.ownVertices = r.ownVertices;
  patch.convexEdges = r.convexEdges;
  patch.edgeEnds = std::span(ends_).subspan(r.firstEnd, r.edges);
  patch.vertexColumns = numbers_.data() + r.firstNumber;
  patch.faceColumns = patch.vertexColumns + 3 * SurfacePatch::padded(r.vertices);
  patch.edgeColumns = patch.faceColumns + 16 * SurfacePatch::padded(r.triangles);
  patch.box = r.box;
  patch.normals = r.normals;
  patch.facing = r.facing;
  patch.lowest = r.lowest;
  patch.highest = r.highest;
  return patch;
}

}  // namespace cairn
