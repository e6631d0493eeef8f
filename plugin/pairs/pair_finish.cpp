// SPDX-License-Identifier: Zlib
#include "pairs/pair_finish.h"

#include "pairs/pair_write.h"

namespace cairn::bullet {

PairReport finish(TreePair& pair, btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy,
                  Budget& budget, ContactScratch& scratch) {
  scratch.chosen.clear();
  return write(pair, measure(pair, policy, budget, scratch), policy, dispatcher, result);
}

}  // namespace cairn::bullet
