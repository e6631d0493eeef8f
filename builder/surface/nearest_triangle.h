// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// The triangle nearest to a finite `query`, nearest child first, four boxes or triangles at a time with the fastest
/// instruction set present; the same bits on every one. On a tie one of them, always the same. Nothing farther than
/// `atMost` is looked at: precondition, some triangle is nearer by more than the rounding of two distances. The answer
/// does not depend on it.
TriangleHierarchy::Place nearestTriangle(const TriangleHierarchy& hierarchy, const Vec3d& query,
                                         double atMost = std::numeric_limits<double>::infinity());

/// A packet of the hierarchy and how far its nearest triangle is from some centre.
struct NearPacket {
  std::uint32_t index = 0;
  double distance = 0;
};

/// Appends the packets with a triangle within `reach` of a finite `query`. False, and only some of them, when there are
/// more than `most`.
bool packetsWithin(const TriangleHierarchy& hierarchy, const Vec3d& query, double reach, std::size_t most,
                   std::vector<NearPacket>& out);

/// `nearestTriangle` of a `query` of which it is known that the packets hold every triangle that can be the one, and
/// its distance. `moved` is how far the query is from the centre of the packets' distances, or more: a packet that much
/// nearer than its own is not looked at when it cannot be among those that decide. It has to cover their rounding.
///
/// A search passes over a triangle for another only where their distances, and those of their boxes, are within
/// rounding of each other. Triangles within `tie`, above that rounding, of the nearest one are searched in the order of
/// `nearestTriangle`; where that are more than `kMaxTied` packets, `decided` is false and one of them is named.
struct NearestAmong {
  static constexpr std::size_t kMaxTied = 32;

  TriangleHierarchy::Place place;
  double distance = 0;
  bool decided = true;
};
NearestAmong nearestAmong(const TriangleHierarchy& hierarchy, std::span<const NearPacket> packets, const Vec3d& query,
                          double moved, double tie);

}  // namespace cairn::builder
