// SPDX-License-Identifier: Zlib
//
// The inner loop of a traversal of two trees, compiled once per instruction set by Highway.
#include "staircase.h"

#include <algorithm>

#include "staircase_batch.h"
#include "vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "staircase.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "staircase-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

/// The oldest `count` pairs of the queue, repeated to a whole batch where there are fewer.
HWY_INLINE const NodePair* wholeBatch(const NodePair* pairs, std::size_t count, NodePair* copy) {
  if (count == StaircaseBatch::kSize) return pairs;
  for (std::uint32_t i = 0; i < StaircaseBatch::kSize; ++i) copy[i] = pairs[i < count ? i : 0];
  return copy;
}

/// How many of the first `count` steps the budget lets through; they are charged.
HWY_INLINE std::uint32_t chargeSteps(const StaircaseBatch& batch, std::uint32_t count, Budget& budget) {
  std::uint32_t cost = 0;
  for (std::uint32_t i = 0; i < count; ++i) cost += batch.cost(i);
  if (budget.charge(cost)) return count;
  std::uint32_t charged = 0;
  while (charged < count && budget.charge(batch.cost(charged))) ++charged;
  return charged;
}

/// Takes the first `count` steps and writes their hits down. Into which tree a step goes and whether it ends at leaves
/// is as good as random, so neither is a branch but an index; that a family holds both leaves and others is rare in
/// most trees.
HWY_INLINE void takeSteps(const StaircaseBody& a, const StaircaseBody& b, const StaircaseBatch& batch,
                          std::uint32_t count, PairList& queue, PairList& leafPairs) {
  constexpr std::size_t kMaxHits = std::size_t{StaircaseBatch::kSize} * kFamilyWidth;
  NodePair* ends[2] = {queue.makeRoom(kMaxHits), leafPairs.makeRoom(kMaxHits)};
  const FamilyTag d;
  const Family* const families[2] = {a.families, b.families};
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t side = batch.side[i];
    const SphereLanes sphere{hn::Set(d, batch.x[i]), hn::Set(d, batch.y[i]), hn::Set(d, batch.z[i]),
                             hn::Set(d, batch.radius[i])};
    const std::uint32_t living = TraversalNode::living(batch.lanes[i]), leaves = TraversalNode::leaves(batch.lanes[i]);
    std::uint32_t hits = overlapLanes(families[side][batch.family[i]], sphere) & living;
    if (leaves - 1 < living - 1) {  // neither none nor all: one comparison, as "none" alone would be a guess
      ends[0] = append(ends[0], batch.firstChild[i], side, hits & ~leaves);
      hits &= leaves;
    }
    NodePair*& end = ends[leaves != 0 ? 1 : 0];
    end = append(end, batch.firstChild[i], side, hits);
  }
  queue.extendTo(ends[0]);
  leafPairs.extendTo(ends[1]);
}

Progress refinePairs(const StaircaseBody& a, const StaircaseBody& b, StaircasePairs pairs, Budget& budget) {
  StaircaseBatch batch;
  NodePair copy[StaircaseBatch::kSize];
  while (pairs.head < pairs.queue.size()) {
    const std::size_t waiting = pairs.queue.size() - pairs.head;
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(waiting, StaircaseBatch::kSize));
    prepare(a, b, wholeBatch(pairs.queue.data() + pairs.head, count, copy), batch);
    const std::uint32_t charged = chargeSteps(batch, count, budget);
    takeSteps(a, b, batch, charged, pairs.queue, pairs.leafPairs);
    pairs.head += charged;
    if (charged < count) return Progress::budgetSpent;
  }
  return Progress::done;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(refinePairs);

Progress refineStaircase(const StaircaseBody& a, const StaircaseBody& b, StaircasePairs pairs, Budget& budget) {
  return HWY_DYNAMIC_DISPATCH(refinePairs)(a, b, pairs, budget);
}

}  // namespace cairn
#endif  // HWY_ONCE
