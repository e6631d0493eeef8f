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

/// The triangle nearest to `query` of those in the packets, its distance and that of the next one; infinite when there
/// is none. Where the two differ by no more than rounding `nearestTriangle` may name the other. `moved` is how far the
/// query is from the centre of the packets' distances, or more: a packet that much nearer than its own is not looked at
/// when it cannot be among the two. It has to cover their rounding.
struct NearestAmong {
  TriangleHierarchy::Place place;
  double distance = 0, second = 0;
};
NearestAmong nearestAmong(const TriangleHierarchy& hierarchy, std::span<const NearPacket> packets, const Vec3d& query,
                          double moved);

}  // namespace cairn::builder
