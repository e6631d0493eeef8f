// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// The boxes of four children as a structure of arrays, and a slab around each: the space between two parallel planes.
/// A slab across the mean normal is far thinner than the box where the surface is oblique to the axes. This is also
/// true for a round surface seen from deep inside. An unused lane is an inverted box at infinity, which no query
/// reaches.
struct alignas(64) HierarchyNode {
  static constexpr int kWidth = 4;
  static constexpr std::uint32_t kPacketBit = 1U << 31;
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  /// Fraction of the largest coordinate by which slabs are widened and by which a distance to a slab is reduced. It is
  /// a thousand times the rounding of the products on both sides. So the computed distance to a triangle is never less
  /// than a query's bound from its slab.
  static constexpr double kSlabShare = 0x1p-40;

  double lower[3][kWidth] = {{kInf, kInf, kInf, kInf}, {kInf, kInf, kInf, kInf}, {kInf, kInf, kInf, kInf}};
  double upper[3][kWidth] = {{-kInf, -kInf, -kInf, -kInf}, {-kInf, -kInf, -kInf, -kInf}, {-kInf, -kInf, -kInf, -kInf}};
  double normal[3][kWidth] = {};  ///< of the slab, of length 1 up to rounding; zero for none
  /// Least and greatest dot product of the normal and a point of the child, widened for rounding: see `kSlabShare`.
  double slabLower[kWidth] = {}, slabUpper[kWidth] = {};
  std::uint32_t child[kWidth] = {};  ///< a node; a packet when kPacketBit is set
  /// By child: its first packet. Packets are numbered in the order of leaves, so a child's packets end where those of
  /// the next child begin. An unused lane has none.
  std::uint32_t firstPacket[kWidth] = {~0U, ~0U, ~0U, ~0U};
};

/// A four-wide bounding-volume hierarchy over the triangles of a mesh, in double precision. It is built top-down by a
/// binned surface-area heuristic (Wald 2007). Nodes are flat; each leaf is one packet of up to four triangles.
class TriangleHierarchy {
 public:
  /// Below this depth ranges are halved by count. Each level of nodes at least halves them, so at most 32 more levels
  /// follow.
  static constexpr std::uint32_t kMaxHeuristicDepth = 32;
  /// Stack entries that a depth-first query needs at most: it pops one and pushes at most four on each level.
  static constexpr std::size_t kStackSize = (HierarchyNode::kWidth - 1) * (kMaxHeuristicDepth + 32) + 1;

  /// Precondition: at least one triangle, none degenerate. O(n log n).
  explicit TriangleHierarchy(const TriangleMesh& mesh);

  /// The position of a triangle in the packets.
  struct Place {
    std::uint32_t packet = 0;
    int lane = 0;
  };
  Place placeOf(std::uint32_t triangle) const { return places_[triangle]; }
  const TrianglePacket& packet(std::uint32_t index) const { return packets_[index]; }
  /// The root is node 0.
  const HierarchyNode& node(std::uint32_t index) const { return nodes_[index]; }

 private:
  class Builder;

  std::vector<HierarchyNode> nodes_;
  std::vector<TrianglePacket> packets_;
  std::vector<Place> places_;  // by triangle
};

}  // namespace cairn::builder
