// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/pair_measure.h"

class btDispatcher;

namespace cairn::bullet {

/// Brings the manifolds up to date with what was measured in this step, through `result`. Calls the user's callbacks.
PairReport write(TreePair& pair, const PairAnswer& answer, const AnswerPolicy& policy, btDispatcher& dispatcher,
                 btManifoldResult& result);

}  // namespace cairn::bullet
