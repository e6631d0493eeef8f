// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

class btDispatcher;

namespace cairn::bullet {

/// Makes contacts from the traversal's leaf pairs, writes the manifolds through `result`, and releases the pair's
/// reservation. Precondition: the pair was begun in this step.
PairReport finish(TreePair& pair, btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy,
                  Budget& budget, ContactScratch& scratch);

}  // namespace cairn::bullet
