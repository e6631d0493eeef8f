// SPDX-License-Identifier: Zlib
#include "pairs/pair_prefetch.h"

#include "platform/prefetch.h"

namespace cairn::bullet {

namespace {

// Bytes of a pair that a step reads, from its beginning. For a collider, about the size of the largest kind in a heap.
constexpr std::size_t kSubjectBytes = 384, kEstimateBytes = 512, kCarryOverBytes = 832, kColliderBytes = 768;

// Unless the pair was culled in the last step.
void prefetchBodies(const TreePair& pair, bool forEstimate) {
  pair.handles.prefetchAlgorithm();
  pair.handles.prefetchBody();
  if (pair.isCulled()) return;
  pair.bodies.prefetchData();
  if (forEstimate) prefetch(&pair.motion, kEstimateBytes);
}

void prefetchLeafPairs(const TreePair& pair) {
  const std::span<const NodePair> pairs = std::as_const(*pair.collider).traversal().leafPairs();
  prefetch(pairs.data(), pairs.size_bytes());
}

}  // namespace

void prefetch(const TreePair& pair, PairPart part) {
  switch (part) {
    case PairPart::subject:
      return prefetch(&pair, kSubjectBytes);
    case PairPart::copies:
      return prefetchBodies(pair, false);
    case PairPart::estimate:
      return prefetchBodies(pair, true);
    case PairPart::notes:
      return prefetch(&pair.notes, sizeof(pair.notes));
    case PairPart::state:
      prefetch(&pair, sizeof(TreePair) - sizeof(PairBodies));
      return pair.bodies.prefetchData();
    case PairPart::lists:
      prefetch(pair.collider.get(), kColliderBytes);
      pair.contacts.prefetchLists();
      return pair.manifolds.prefetchCounts();
    case PairPart::leafPairs:
      prefetchLeafPairs(pair);
      return pair.manifolds.prefetchPoints();
    case PairPart::carriedOver:
      prefetch(&pair.motion, kCarryOverBytes);
      return pair.bodies.prefetchData();
    case PairPart::carriedBodies:
      pair.handles.prefetchBody();
      return pair.manifolds.prefetchCounts();
    case PairPart::points:
      return pair.manifolds.prefetchPoints();
  }
}

}  // namespace cairn::bullet
