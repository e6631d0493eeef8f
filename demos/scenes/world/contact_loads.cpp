// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/contact_loads.h"

#include <algorithm>
#include <utility>

namespace cairn::scenes {

void ContactLoads::update(const btCollisionDispatcher& dispatcher) {
  std::map<Pair, double> loads;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const btCollisionObject &first = *manifold.getBody0(), &second = *manifold.getBody1();
    const Pair pair = std::minmax({first.getUserIndex(), second.getUserIndex()});
    const auto isAsleep = [](const btCollisionObject& body) { return body.isStaticObject() || !body.isActive(); };
    if (isAsleep(first) && isAsleep(second)) {
      loads[pair] = between(pair.first, pair.second);
      continue;
    }
    for (int c = 0; c < manifold.getNumContacts(); ++c) loads[pair] += manifold.getContactPoint(c).getAppliedImpulse();
  }
  loads_ = std::move(loads);
}

double ContactLoads::between(int first, int second) const {
  const auto entry = loads_.find(std::minmax({first, second}));
  return entry == loads_.end() ? 0 : entry->second;
}

}  // namespace cairn::scenes
