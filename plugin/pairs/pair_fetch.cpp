// SPDX-License-Identifier: Zlib
#include "pairs/pair_fetch.h"

#include "memory/fetch_ahead.h"

namespace cairn::bullet {

namespace {

// Of what a step looks at, from its beginning; of a counterpart about as much as the largest of those a heap has.
constexpr std::size_t kSubjectBytes = 384, kSurveyBytes = 512, kHeldBytes = 832, kCounterpartBytes = 768;

// Unless the pair was settled in the last step.
void fetchBodies(const TreePair& pair, bool forSurvey) {
  pair.handles.fetchAlgorithm();
  pair.handles.fetchBody();
  if (pair.isSettled()) return;
  pair.bodies.fetch();
  if (forSurvey) fetchAhead(&pair.motion, kSurveyBytes);
}

void fetchLeafPairs(const TreePair& pair) {
  const std::span<const NodePair> pairs = std::as_const(*pair.counterpart).traversal().leafPairs();
  fetchAhead(pairs.data(), pairs.size_bytes());
}

}  // namespace

void fetch(const TreePair& pair, PairPart part) {
  switch (part) {
    case PairPart::subject:
      return fetchAhead(&pair, kSubjectBytes);
    case PairPart::copies:
      return fetchBodies(pair, false);
    case PairPart::need:
      return fetchBodies(pair, true);
    case PairPart::notes:
      return fetchAhead(&pair.notes, sizeof(pair.notes));
    case PairPart::state:
      fetchAhead(&pair, sizeof(TreePair) - sizeof(PairBodies));
      return pair.bodies.fetch();
    case PairPart::lists:
      fetchAhead(pair.counterpart.get(), kCounterpartBytes);
      pair.contacts.fetchLists();
      return pair.manifolds.fetchCounts();
    case PairPart::leafPairs:
      fetchLeafPairs(pair);
      return pair.manifolds.fetchPoints();
    case PairPart::held:
      fetchAhead(&pair.motion, kHeldBytes);
      return pair.bodies.fetch();
    case PairPart::heldBodies:
      pair.handles.fetchBody();
      return pair.manifolds.fetchCounts();
    case PairPart::points:
      return pair.manifolds.fetchPoints();
  }
}

}  // namespace cairn::bullet
