// SPDX-License-Identifier: Zlib
#include "dispatch/forwarding_broadphase.h"

#include "dispatch/narrow_phase_impl.h"

namespace cairn::bullet {

void ForwardingPairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                                     const btDispatcherInfo& info) {
  const bool isStep = dispatcher == &dispatcher_;
  if (isStep) narrowPhase_.beginStep(*this, info);
  to().processAllOverlappingPairs(callback, dispatcher, info);
  if (isStep) narrowPhase_.endStep();
}

}  // namespace cairn::bullet
