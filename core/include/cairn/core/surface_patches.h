// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/surface_features.h"

namespace cairn {

class SphereTree;

/// An axis-parallel box.
struct Box {
  Vec3 lower, upper;

  void add(const Vec3& p);
  Vec3 middle() const { return (lower + upper) * 0.5F; }
};

/// A few triangles of a surface that lie together, with their edges and vertices. Lists are indices of the mesh's
/// features; rows of numbers hold one column after the other, each padded to whole batches.
struct SurfacePatch {
  static constexpr std::uint32_t kBatch = 8;
  static constexpr std::uint32_t kMaxTriangles = 16;
  static constexpr std::uint32_t kMaxFeatures = 3 * kMaxTriangles;  ///< vertices, and edges

  std::span<const std::uint32_t> vertices, edges, triangles;
  std::uint32_t convexEdges = 0;  ///< so many of `edges` are convex, the first ones
  /// Of each edge, its ends by their places in `vertices`.
  std::span<const std::array<std::uint8_t, 2>> edgeEnds;
  const float* vertexColumns = nullptr;  ///< x, y, z; the last vertex is repeated
  const float* faceColumns = nullptr;    ///< normal and offset, then those of the three sides; what pads has no normal
  const float* edgeColumns = nullptr;    ///< of convex ones: first end, second end, outward; what pads has no length
  Box box;                               ///< of the vertices
  Box normals;                           ///< of all directions within the cone of the patch's normals

  static constexpr std::uint32_t padded(std::size_t count) {
    return (static_cast<std::uint32_t>(count) + kBatch - 1) / kBatch * kBatch;
  }
};

/// Every leaf's patches: they hold all triangles the leaf has a piece of, at most `kMaxTriangles` each. Where an
/// ancestor holds no more than that, all leaves below the topmost such node have its patch in common: a cube is one
/// patch, however many leaves it has. Immutable.
class SurfacePatches {
 public:
  SurfacePatches() = default;
  SurfacePatches(const SphereTree& tree, const SurfaceFeatures& features);

  struct Range {
    std::uint32_t first = 0, count = 0;
  };
  /// By `NodeId` of a leaf.
  Range patchesOf(std::uint32_t leaf) const { return patchesOf_[leaf]; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(records_.size()); }
  SurfacePatch patch(std::uint32_t index) const;
  const Box& box(std::uint32_t index) const { return records_[index].box; }
  std::size_t memoryBytes() const;

 private:
  struct Record {
    Box box, normals;
    std::uint32_t firstIndex = 0, firstEnd = 0, firstNumber = 0;
    std::uint16_t vertices = 0, edges = 0, triangles = 0, convexEdges = 0;
  };
  class Maker;

  std::vector<Range> patchesOf_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::array<std::uint8_t, 2>> ends_;
  std::vector<float> numbers_;
};

}  // namespace cairn
