// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "surface/triangle_hierarchy.h"

namespace cairn::builder {

/// Returns the triangle nearest to a finite `query`. The search visits the nearest child first, four boxes or triangles
/// at a time with the fastest instruction set present. The bits do not depend on the instruction set. A tie always
/// gives the same triangle. Triangles farther than `atMost` are not examined. Precondition: some triangle is nearer
/// than `atMost` by more than the rounding of two distances. The answer does not depend on `atMost`.
TriangleHierarchy::Place nearestTriangle(const TriangleHierarchy& hierarchy, const Vec3d& query,
                                         double atMost = std::numeric_limits<double>::infinity());

/// A packet of the hierarchy, and the distance of its nearest triangle from some centre.
struct NearPacket {
  std::uint32_t index = 0;
  double distance = 0;
};

/// Appends the packets with a triangle within `reach` of a finite `query`. Returns false when there are more than
/// `most`; `out` then has only some of them.
bool packetsWithin(const TriangleHierarchy& hierarchy, const Vec3d& query, double reach, std::size_t most,
                   std::vector<NearPacket>& out);

/// Returns `nearestTriangle` of `query` and its distance, from packets alone. Precondition: the packets hold every
/// triangle that can be the answer. `moved` is an upper bound of the distance from the query to the centre of the
/// packets' distances, rounding included. A packet is skipped when its distance less `moved` shows that it cannot
/// decide.
///
/// A search prefers one triangle to another only where their distances, and those of their boxes, differ by more than
/// rounding. Triangles within `tie` of the nearest one are searched in the order of `nearestTriangle`; `tie` must
/// exceed that rounding. With more than `kMaxTied` such packets, `decided` is false and `place` is any one of them.
struct NearestAmong {
  static constexpr std::size_t kMaxTied = 32;

  TriangleHierarchy::Place place;
  double distance = 0;
  bool decided = true;
};
NearestAmong nearestAmong(const TriangleHierarchy& hierarchy, std::span<const NearPacket> packets, const Vec3d& query,
                          double moved, double tie);

}  // namespace cairn::builder
