// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compiled once per instruction set by Highway; the best one the machine has is chosen when the program runs. Products
// and sums stay separate (no fused multiply-add) and in one order, so that every target gives the same bits.
#include "surface/nearest_triangle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "surface/nearest_triangle.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "surface/infinity.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::builder::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<double, 4>;
using V = hn::Vec<Lanes>;

/// Squared distance of the query to four boxes.
HWY_INLINE void distancesSq(const HierarchyNode& node, const Vec3d& query, double* HWY_RESTRICT out) {
  const Lanes d;
  for (std::size_t i = 0; i < HierarchyNode::kWidth; i += hn::Lanes(d)) {
    V sum = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const V q = hn::Set(d, query[axis]);
      const V below = hn::Sub(hn::Load(d, node.lower[axis] + i), q);
      const V above = hn::Sub(q, hn::Load(d, node.upper[axis] + i));
      const V gap = hn::Max(hn::Max(below, above), hn::Zero(d));
      sum = hn::Add(sum, hn::Mul(gap, gap));
    }
    hn::Store(sum, d, out + i);
  }
}

/// Lower bounds of the squared distance from the query to each of four children: the greater of `boxes` and the
/// distance to the slab.
HWY_INLINE void slabBoundsSq(const HierarchyNode& node, const Vec3d& query, const double* boxes, double* out) {
  const Lanes d;
  for (std::size_t i = 0; i < HierarchyNode::kWidth; i += hn::Lanes(d)) {
    const V x = hn::Mul(hn::Set(d, query.x), hn::Load(d, node.normal[0] + i));
    const V y = hn::Mul(hn::Set(d, query.y), hn::Load(d, node.normal[1] + i));
    const V z = hn::Mul(hn::Set(d, query.z), hn::Load(d, node.normal[2] + i));
    const V along = hn::Add(hn::Add(x, y), z);
    const V below = hn::Sub(hn::Load(d, node.slabLower + i), along);
    const V above = hn::Sub(along, hn::Load(d, node.slabUpper + i));
    const V gap = hn::Mul(hn::Max(hn::Max(below, above), hn::Zero(d)), hn::Set(d, 1 - HierarchyNode::kSlabShare));
    hn::Store(hn::Max(hn::Mul(gap, gap), hn::Load(d, boxes + i)), d, out + i);
  }
}

/// Nearest point of one edge per lane, within the planes. Every edge starts on the line AB, at (start, 0).
struct EdgePoints {
  V x, y, distanceSq;
};

HWY_INLINE EdgePoints nearestOnEdges(V x, V y, V start, V directionX, V directionY, V length) {
  const Lanes d;
  const V fromStart = hn::Sub(x, start);
  const V along = hn::Add(hn::Mul(fromStart, directionX), hn::Mul(y, directionY));
  const V clamped = hn::Min(hn::Max(along, hn::Zero(d)), length);
  const V pointX = hn::Add(start, hn::Mul(clamped, directionX)), pointY = hn::Mul(clamped, directionY);
  const V dx = hn::Sub(x, pointX), dy = hn::Sub(y, pointY);
  return {pointX, pointY, hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy))};
}

HWY_INLINE void keepNearer(EdgePoints& best, const EdgePoints& other) {
  const auto nearer = hn::Lt(other.distanceSq, best.distanceSq);
  best.x = hn::IfThenElse(nearer, other.x, best.x);
  best.y = hn::IfThenElse(nearer, other.y, best.y);
  best.distanceSq = hn::IfThenElse(nearer, other.distanceSq, best.distanceSq);
}

/// Squared distance of the query to four triangles. `TrianglePacket::nearest` is its scalar twin.
HWY_INLINE void distancesSq(const TrianglePacket& t, const Vec3d& query, double* HWY_RESTRICT out) {
  const Lanes d;
  const V zero = hn::Zero(d);
  for (std::size_t i = 0; i < TrianglePacket::kWidth; i += hn::Lanes(d)) {
    const V px = hn::Sub(hn::Set(d, query.x), hn::Load(d, t.originX + i));
    const V py = hn::Sub(hn::Set(d, query.y), hn::Load(d, t.originY + i));
    const V pz = hn::Sub(hn::Set(d, query.z), hn::Load(d, t.originZ + i));
    const V ux = hn::Load(d, t.uX + i), uy = hn::Load(d, t.uY + i), uz = hn::Load(d, t.uZ + i);
    const V vx = hn::Load(d, t.vX + i), vy = hn::Load(d, t.vY + i), vz = hn::Load(d, t.vZ + i);
    const V x = hn::Add(hn::Add(hn::Mul(px, ux), hn::Mul(py, uy)), hn::Mul(pz, uz));
    const V y = hn::Add(hn::Add(hn::Mul(px, vx), hn::Mul(py, vy)), hn::Mul(pz, vz));
    const V ab = hn::Load(d, t.lengthAB + i), fromB = hn::Sub(x, ab);
    const V acX = hn::Load(d, t.acX + i), acY = hn::Load(d, t.acY + i);
    const V bcX = hn::Load(d, t.bcX + i), bcY = hn::Load(d, t.bcY + i);

    EdgePoints best = nearestOnEdges(x, y, zero, hn::Set(d, 1.0), zero, ab);
    keepNearer(best, nearestOnEdges(x, y, ab, bcX, bcY, hn::Load(d, t.lengthBC + i)));
    keepNearer(best, nearestOnEdges(x, y, zero, acX, acY, hn::Load(d, t.lengthAC + i)));
    const auto inside = hn::And(hn::Ge(y, zero), hn::And(hn::Le(hn::Mul(acX, y), hn::Mul(acY, x)),
                                                         hn::Ge(hn::Mul(bcX, y), hn::Mul(bcY, fromB))));
    const V nearX = hn::IfThenElse(inside, x, best.x), nearY = hn::IfThenElse(inside, y, best.y);
    const V dx = hn::Sub(hn::Sub(px, hn::Mul(nearX, ux)), hn::Mul(nearY, vx));
    const V dy = hn::Sub(hn::Sub(py, hn::Mul(nearX, uy)), hn::Mul(nearY, vy));
    const V dz = hn::Sub(hn::Sub(pz, hn::Mul(nearX, uz)), hn::Mul(nearY, vz));
    hn::Store(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)), d, out + i);
  }
}

/// Bit i is set when value i is less than `limit`.
HWY_INLINE unsigned lessBits(const double* HWY_RESTRICT values, double limit) {
  const Lanes d;
  unsigned all = 0;
  for (std::size_t i = 0; i < HierarchyNode::kWidth; i += hn::Lanes(d)) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Lt(hn::Load(d, values + i), hn::Set(d, limit)), bits);
    all |= unsigned{bits[0]} << i;
  }
  return all;
}

HWY_INLINE double leastOf(const double* distances) {
  return std::min(std::min(distances[0], distances[1]), std::min(distances[2], distances[3]));
}

/// Some packets of a hierarchy, and one bit for each: whether a search may still visit it.
struct TiedPackets {
  struct Tied {
    std::uint32_t index;
    double distanceSq;
  };
  std::array<Tied, NearestAmong::kMaxTied> list;
  std::size_t size = 0;

  /// False when there is no room, even after the removal of packets that are not nearer than `limitSq`.
  bool add(const Tied& tied, double limitSq) {
    if (size == list.size()) drop(limitSq);
    if (size == list.size()) return false;
    list[size++] = tied;
    return true;
  }
  void drop(double limitSq) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i)
      if (list[i].distanceSq < limitSq) list[kept++] = list[i];
    size = kept;
  }
  std::uint32_t all() const { return ~std::uint32_t{0} >> (list.size() - size); }

  /// Divides the packets `which` below a node among its children. Returns one bit for each child that has any.
  unsigned below(const HierarchyNode& node, std::uint32_t which, std::array<std::uint32_t, 4>& byChild) const {
    byChild = {};
    unsigned children = 0;
    for (; which != 0; which &= which - 1) {
      const int i = std::countr_zero(which);
      int child = 0;
      for (int lane = 1; lane < HierarchyNode::kWidth; ++lane) child += node.firstPacket[lane] <= list[i].index ? 1 : 0;
      byChild[child] |= std::uint32_t{1} << i;
      children |= 1U << child;
    }
    return children;
  }
};
static_assert(NearestAmong::kMaxTied == 32 && HierarchyNode::kWidth == 4);

/// Depth first, nearest box first. With `tied`, the search visits only the paths to those packets.
template <bool kOnlyTied>
HWY_INLINE TriangleHierarchy::Place search(const TriangleHierarchy& hierarchy, const Vec3d& query, double atMostSq,
                                           const TiedPackets* tied) {
  struct Entry {
    double boundSq;  // no triangle of the child is nearer
    double boxSq;
    std::uint32_t child;
    std::uint32_t which;  // of the tied
  };
  std::array<Entry, TriangleHierarchy::kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0, 0, kOnlyTied ? tied->all() : 0};
  double best = atMostSq;
  TriangleHierarchy::Place place;
  alignas(32) double distances[HierarchyNode::kWidth], bounds[HierarchyNode::kWidth];
  std::array<std::uint32_t, HierarchyNode::kWidth> byChild{};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.boundSq >= best) continue;
    if (entry.child & HierarchyNode::kPacketBit) {
      const std::uint32_t index = entry.child & ~HierarchyNode::kPacketBit;
      distancesSq(hierarchy.packet(index), query, distances);
      for (unsigned nearer = lessBits(distances, best); nearer != 0; nearer &= nearer - 1) {
        const int lane = std::countr_zero(nearer);
        if (distances[lane] < best) best = distances[lane], place = {index, lane};
      }
      continue;
    }
    const HierarchyNode& node = hierarchy.node(entry.child);
    distancesSq(node, query, distances);
    if (lessBits(distances, best) == 0) continue;
    slabBoundsSq(node, query, distances, bounds);
    unsigned nearer = lessBits(bounds, best);
    if constexpr (kOnlyTied) nearer &= tied->below(node, entry.which, byChild);
    const std::size_t bottom = size;
    for (; nearer != 0; nearer &= nearer - 1) {
      const int lane = std::countr_zero(nearer);
      // Insertion by descending distance: the child with the nearest box is on top of the stack.
      std::size_t at = size++;
      for (; at > bottom && stack[at - 1].boxSq < distances[lane]; --at) stack[at] = stack[at - 1];
      stack[at] = {bounds[lane], distances[lane], node.child[lane], byChild[lane]};
    }
  }
  return place;
}

TriangleHierarchy::Place nearest(const TriangleHierarchy& hierarchy, const Vec3d& query, double atMost) {
  return search<false>(hierarchy, query, atMost * atMost, nullptr);
}

bool packetsWithin(const TriangleHierarchy& hierarchy, const Vec3d& query, double reach, std::size_t most,
                   std::vector<NearPacket>& out) {
  std::array<std::uint32_t, TriangleHierarchy::kStackSize> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  const double reachSq = reach * reach;
  alignas(32) double distances[HierarchyNode::kWidth];
  while (size > 0) {
    const std::uint32_t child = stack[--size];
    if (child & HierarchyNode::kPacketBit) {
      const std::uint32_t index = child & ~HierarchyNode::kPacketBit;
      distancesSq(hierarchy.packet(index), query, distances);
      const double least = leastOf(distances);
      if (least > reachSq) continue;
      if (out.size() == most) return false;
      out.push_back({index, std::sqrt(least)});
      continue;
    }
    const HierarchyNode& node = hierarchy.node(child);
    distancesSq(node, query, distances);
    slabBoundsSq(node, query, distances, distances);
    for (int lane = 0; lane < HierarchyNode::kWidth; ++lane)
      if (distances[lane] <= reachSq) stack[size++] = node.child[lane];
  }
  return true;
}

NearestAmong nearestAmong(const TriangleHierarchy& hierarchy, std::span<const NearPacket> packets, const Vec3d& query,
                          double moved, double tie) {
  NearestAmong result;
  TiedPackets tied;
  double best = kInfinity, limitSq = kInfinity;
  double reach = kInfinity;  // a packet beyond it, seen from the centre, is outside the limit
  alignas(32) double distances[TrianglePacket::kWidth];
  for (const NearPacket& near : packets) {
    if (near.distance > reach) continue;
    distancesSq(hierarchy.packet(near.index), query, distances);
    const double least = leastOf(distances);
    if (least >= limitSq) continue;
    if (least < best) {
      best = least;
      result.distance = std::sqrt(best);
      result.place = {near.index,
                      static_cast<int>(std::find(distances, distances + TrianglePacket::kWidth, least) - distances)};
      const double limit = result.distance + tie;
      limitSq = limit * limit;
      reach = limit + moved;
    }
    result.decided = tied.add({near.index, least}, limitSq) && result.decided;
  }
  tied.drop(limitSq);
  if (result.decided && tied.size > 1) result.place = search<true>(hierarchy, query, limitSq, &tied);
  return result;
}

}  // namespace cairn::builder::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::builder {

HWY_EXPORT(nearest);

TriangleHierarchy::Place nearestTriangle(const TriangleHierarchy& hierarchy, const Vec3d& query, double atMost) {
  return HWY_DYNAMIC_DISPATCH(nearest)(hierarchy, query, atMost);
}

HWY_EXPORT(packetsWithin);

bool packetsWithin(const TriangleHierarchy& hierarchy, const Vec3d& query, double reach, std::size_t most,
                   std::vector<NearPacket>& out) {
  return HWY_DYNAMIC_DISPATCH(packetsWithin)(hierarchy, query, reach, most, out);
}

HWY_EXPORT(nearestAmong);

NearestAmong nearestAmong(const TriangleHierarchy& hierarchy, std::span<const NearPacket> packets, const Vec3d& query,
                          double moved, double tie) {
  return HWY_DYNAMIC_DISPATCH(nearestAmong)(hierarchy, packets, query, moved, tie);
}

}  // namespace cairn::builder
#endif
