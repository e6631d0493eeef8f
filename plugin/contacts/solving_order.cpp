// SPDX-License-Identifier: Zlib
#include "contacts/solving_order.h"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <utility>

namespace cairn::bullet {

// Insertion sort: there are four points at most, in order already in most steps.
void putDeepestLast(btPersistentManifold& manifold) {
  for (int i = 1; i < manifold.getNumContacts(); ++i)
    for (int k = i; k > 0; --k) {
      btManifoldPoint &before = manifold.getContactPoint(k - 1), &point = manifold.getContactPoint(k);
      if (before.m_distance1 >= point.m_distance1) break;
      std::swap(before, point);
    }
}

}  // namespace cairn::bullet
