// SPDX-License-Identifier: Zlib
// Bodies that are no number.
#include <algorithm>

#include "pairs/body_motion.h"
#include "pairs/tree_pair.h"

namespace cairn::bullet {

bool TreePair::settleBroken(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  if (!isBroken(body0) && !isBroken(body1)) return false;
  forgetBroken();
  return true;
}

bool TreePair::isLeftOver() const {
  return mayHavePoints_ && std::ranges::any_of(manifolds_, [](const btPersistentManifold* m) {
           return m && m->getNumContacts() > 0 && (isBroken(*m->getBody0()) || isBroken(*m->getBody1()));
         });
}

void TreePair::forgetBroken() {
  forget();
  isBroken_ = true;
  isSettled_.store(true, std::memory_order_relaxed);
}

}  // namespace cairn::bullet
