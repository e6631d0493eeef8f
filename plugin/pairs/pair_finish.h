// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/pair_report.h"
#include "pairs/tree_pair.h"

class btDispatcher;

namespace cairn::bullet {

/// From what the traversal found to the manifolds: brings them up to date through `result`, and redeems the promise.
/// Precondition: begun in this step.
PairReport finish(TreePair& pair, btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy,
                  Budget& budget, ContactScratch& scratch);

}  // namespace cairn::bullet
