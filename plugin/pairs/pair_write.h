// SPDX-License-Identifier: Zlib
#pragma once

#include "pairs/pair_measure.h"

class btDispatcher;

namespace cairn::bullet {

/// Writes the contacts measured in this step into the manifolds, through `result`. Calls users' callbacks.
PairReport write(TreePair& pair, const PairAnswer& answer, const AnswerPolicy& policy, btDispatcher& dispatcher,
                 btManifoldResult& result);

}  // namespace cairn::bullet
