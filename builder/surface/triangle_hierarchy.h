// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cairn/builder/triangle_mesh.h"
#include "surface/triangle_packet.h"

namespace cairn::builder {

/// The boxes of four children, structure of arrays, and a slab around each: the space between two parallel planes.
/// Where the surface is oblique to the axes, or round and seen from deep inside, a slab across its mean normal is far
/// thinner than its box. A dead lane is an inverted box at infinity, which no query reaches.
struct alignas(64) HierarchyNode {
  static constexpr int kWidth = 4;
  static constexpr std::uint32_t kPacketBit = 1U << 31;
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  /// Slabs are moved apart by this part of the largest coordinate, and a distance to one counts for this part less. It
  /// is a thousand times the rounding of the products on both sides, so a triangle is never as near, as computed, as a
  /// query's distance to its slab says it cannot be.
  static constexpr double kSlabShare = 0x1p-40;

  double lower[3][kWidth] = {{kInf, kInf, kInf, kInf}, {kInf, kInf, kInf, kInf}, {kInf, kInf, kInf, kInf}};
  double upper[3][kWidth] = {{-kInf, -kInf, -kInf, -kInf}, {-kInf, -kInf, -kInf, -kInf}, {-kInf, -kInf, -kInf, -kInf}};
  double normal[3][kWidth] = {};  ///< of the slab, of unit length but for rounding; zero for none
  /// Least and greatest dot product of the normal and a point of the child, moved apart for rounding: see `kSlabShare`.
  double slabLower[kWidth] = {}, slabUpper[kWidth] = {};
  std::uint32_t child[kWidth] = {};  ///< a node, or a packet when kPacketBit is set
  /// By child: packets are numbered as their leaves come, so its own begin here and end where the next one's begin. A
  /// dead lane has none.
  std::uint32_t firstPacket[kWidth] = {~0U, ~0U, ~0U, ~0U};
};

/// A four-wide bounding-volume hierarchy over the triangles of a mesh, in double precision.
/// Built top-down by binned surface-area heuristic (Wald 2007); flat nodes, one packet of up to four triangles a leaf.
class TriangleHierarchy {
 public:
  /// Below this depth ranges are halved by count, which ends within 32 levels more: each level of nodes at least
  /// halves.
  static constexpr std::uint32_t kMaxHeuristicDepth = 32;
  /// Entries a depth-first query needs at most: it pops one and pushes at most four a level.
  static constexpr std::size_t kStackSize = (HierarchyNode::kWidth - 1) * (kMaxHeuristicDepth + 32) + 1;

  /// Precondition: at least one triangle, none degenerate. O(n log n).
  explicit TriangleHierarchy(const TriangleMesh& mesh);

  /// Where a triangle is kept.
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
