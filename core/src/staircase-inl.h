// SPDX-License-Identifier: Zlib
//
// How eight steps of a staircase traversal are prepared and how their hits are written down, once per instruction set.
// Without vectors (Highway's scalar target) both are said one step and one lane after the other.
#if defined(CAIRN_STAIRCASE_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_STAIRCASE_INL_H
#undef CAIRN_STAIRCASE_INL_H
#else
#define CAIRN_STAIRCASE_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "cairn/core/bit_cast.h"
#include "columns-inl.h"
#include "family-inl.h"
#include "staircase_batch.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE void prepare(const StaircaseBody& a, const StaircaseBody& b, const NodePair* pairs, StaircaseBatch& batch) {
  for (std::uint32_t i = 0; i < StaircaseBatch::kSize; ++i) {
    const TraversalNode &nodeA = a.nodes[pairs[i].a], &nodeB = b.nodes[pairs[i].b];
    const bool isLeafA = nodeA.childFamily == 0, isLeafB = nodeB.childFamily == 0;
    const bool intoA = !isLeafA && (isLeafB || nodeA.error * a.scale >= nodeB.error * b.scale);
    const StaircaseBody& body = intoA ? a : b;
    const TraversalNode &split = intoA ? nodeA : nodeB, &other = intoA ? nodeB : nodeA;
    const Vec3 center = body.fromOther * other.center;
    batch.x[i] = center.x;
    batch.y[i] = center.y;
    batch.z[i] = center.z;
    batch.radius[i] = other.radius * body.fromOther.scale + body.margin;
    batch.family[i] = split.childFamily;
    const std::uint32_t leaves = TraversalNode::kLaneMask << TraversalNode::kLeafShift;
    batch.lanes[i] = (intoA ? isLeafB : isLeafA) ? split.childLanes : split.childLanes & ~leaves;
    const std::uint32_t child = split.childFamily * kFamilyWidth;
    batch.firstChild[i] = intoA ? NodePair{child, pairs[i].b} : NodePair{pairs[i].a, child};
    batch.side[i] = intoA ? 0 : 1;
  }
}

HWY_INLINE NodePair* append(NodePair* end, const NodePair& first, std::uint32_t side, std::uint32_t hits) {
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(hits));
    *end++ = side == 0 ? NodePair{first.a + lane, first.b} : NodePair{first.a, first.b + lane};
  }
  return end;
}

#else

using StepTag = FamilyTag;  // a step per lane
using StepIds = hn::RebindToUnsigned<StepTag>;

/// The spheres in the frame of the tree that is `to`, with its margin.
HWY_INLINE Columns movedSpheres(const StaircaseBody& to, const Columns& s) {
  const StepTag d;
  const PointColumns center = moved(to.fromOther, {s.x, s.y, s.z});
  return {center.x, center.y, center.z, hn::Add(hn::Mul(s.w, hn::Set(d, to.fromOther.scale)), hn::Set(d, to.margin))};
}

/// As many steps as there are lanes, from `first` on.
HWY_INLINE void prepareLanes(const StaircaseBody& a, const StaircaseBody& b, const NodePair* pairs,
                             StaircaseBatch& batch, std::uint32_t first) {
  const StepTag d;
  const StepIds ids;
  const auto nodeA = [&](std::uint32_t i) HWY_ATTR { return a.nodes + pairs[first + i].a; };
  const auto nodeB = [&](std::uint32_t i) HWY_ATTR { return b.nodes + pairs[first + i].b; };

  const Columns linkA = loadColumns(nodeA, 4), linkB = loadColumns(nodeB, 4);
  const auto familyA = hn::BitCast(ids, linkA.x), familyB = hn::BitCast(ids, linkB.x);
  const auto isLeafA = hn::Eq(familyA, hn::Zero(ids)), isLeafB = hn::Eq(familyB, hn::Zero(ids));
  const auto isWorseA =
      hn::RebindMask(ids, hn::Ge(hn::Mul(linkA.y, hn::Set(d, a.scale)), hn::Mul(linkB.y, hn::Set(d, b.scale))));
  const auto intoA = hn::AndNot(isLeafA, hn::Or(isLeafB, isWorseA));
  hn::Store(hn::IfThenZeroElse(intoA, hn::Set(ids, 1)), ids, batch.side + first);

  // Both ways, always: which one counts is as good as random, and a wrong guess would cost more.
  const Columns inA = movedSpheres(a, loadColumns(nodeB, 0)), inB = movedSpheres(b, loadColumns(nodeA, 0));
  const auto choose = hn::RebindMask(d, intoA);
  const Columns sphere{hn::IfThenElse(choose, inA.x, inB.x), hn::IfThenElse(choose, inA.y, inB.y),
                       hn::IfThenElse(choose, inA.z, inB.z), hn::IfThenElse(choose, inA.w, inB.w)};
  hn::Store(sphere.x, d, batch.x + first);
  hn::Store(sphere.y, d, batch.y + first);
  hn::Store(sphere.z, d, batch.z + first);
  hn::Store(sphere.w, d, batch.radius + first);

  const auto family = hn::IfThenElse(intoA, familyA, familyB);
  const auto lanes = hn::IfThenElse(intoA, hn::BitCast(ids, linkA.z), hn::BitCast(ids, linkB.z));
  const auto isOtherLeaf = hn::Or(hn::And(intoA, isLeafB), hn::AndNot(intoA, isLeafA));
  const auto noLeaves = hn::Set(ids, ~(TraversalNode::kLaneMask << TraversalNode::kLeafShift));
  hn::Store(family, ids, batch.family + first);
  hn::Store(hn::IfThenElse(isOtherLeaf, lanes, hn::And(lanes, noLeaves)), ids, batch.lanes + first);

  hn::Vec<StepIds> namesA, namesB;
  hn::LoadInterleaved2(ids, &pairs[first].a, namesA, namesB);
  const auto child = hn::ShiftLeft<3>(family);
  hn::StoreInterleaved2(hn::IfThenElse(intoA, child, namesA), hn::IfThenElse(intoA, namesB, child), ids,
                        &batch.firstChild[first].a);
}

HWY_INLINE void prepare(const StaircaseBody& a, const StaircaseBody& b, const NodePair* pairs, StaircaseBatch& batch) {
  for (std::uint32_t first = 0; first < StaircaseBatch::kSize; first += hn::Lanes(StepTag()))
    prepareLanes(a, b, pairs, batch, first);
}

/// Writes eight pairs behind `end`, those hit first, and returns the end of these. Four a vector at most: longer stores
/// would each fall into two cache lines.
HWY_INLINE NodePair* append(NodePair* end, const NodePair& first, std::uint32_t side, std::uint32_t hits) {
  const hn::CappedTag<std::uint64_t, 4> d;  // a pair per lane; nothing carries from one half into the other
  const hn::Repartition<std::uint8_t, decltype(d)> bytes;
  const auto base = hn::Set(d, bitCast<std::uint64_t>(first));
  const auto lanes = hn::BitCast(bytes, hn::Set(d, kHitLanes.lanes[hits]));
  for (std::uint32_t i = 0; i < kFamilyWidth; i += hn::Lanes(d)) {
    const auto placed = hn::TableLookupBytesOr0(lanes, hn::Load(bytes, kLanePlaces.places[side][i]));
    hn::StoreU(hn::Add(base, hn::BitCast(d, placed)), d, reinterpret_cast<std::uint64_t*>(end + i));
  }
  return end + std::popcount(hits);
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
