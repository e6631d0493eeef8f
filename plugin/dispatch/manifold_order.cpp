// SPDX-License-Identifier: Zlib
#include "cairn/bullet/manifold_order.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <set>
#include <span>
#include <tuple>
#include <type_traits>

#include "cairn/core/bit_cast.h"
#include "platform/virtual_table.h"

namespace cairn::bullet {

namespace {

std::uint64_t idOf(const btCollisionObject& body) {
  const btBroadphaseProxy* const proxy = body.getBroadphaseHandle();
  return proxy ? static_cast<std::uint32_t>(proxy->m_uniqueId) : 0;
}

std::uint64_t bodiesOf(const btPersistentManifold& manifold) {
  return idOf(*manifold.getBody0()) << 32 | idOf(*manifold.getBody1());
}

// NaN needs a place in the order as well.
auto bitsOf(btScalar number) {
  return bitCast<std::conditional_t<sizeof(btScalar) == 8, std::uint64_t, std::uint32_t>>(number);
}

auto keyOf(const btManifoldPoint& point) {
  const btVector3& at = point.m_localPointB;
  return std::tuple(point.m_partId0, point.m_index0, point.m_partId1, point.m_index1, bitsOf(at.x()), bitsOf(at.y()),
                    bitsOf(at.z()), bitsOf(point.getDistance()));
}

bool isBefore(const btPersistentManifold* a, const btPersistentManifold* b) {
  const std::uint64_t bodiesA = bodiesOf(*a), bodiesB = bodiesOf(*b);
  if (bodiesA != bodiesB) return bodiesA < bodiesB;
  if (a->getNumContacts() != b->getNumContacts()) return a->getNumContacts() < b->getNumContacts();
  for (int i = 0; i < a->getNumContacts(); ++i) {
    const auto keyA = keyOf(a->getContactPoint(i)), keyB = keyOf(b->getContactPoint(i));
    if (keyA != keyB) return keyA < keyB;
  }
  return false;
}

}  // namespace

void orderManifolds(std::span<btPersistentManifold*> manifolds, btDispatcher& dispatcher) {
  if (std::ranges::is_sorted(manifolds, isBefore)) return;
  std::ranges::sort(manifolds, isBefore);
  if (dispatcher.getInternalManifoldPointer() != manifolds.data()) return;
  for (std::size_t i = 0; i < manifolds.size(); ++i) manifolds[i]->m_index1a = static_cast<int>(i);
}

void orderManifolds(btCollisionDispatcher& dispatcher) {
  orderManifolds({dispatcher.getInternalManifoldPointer(), static_cast<std::size_t>(dispatcher.getNumManifolds())},
                 dispatcher);
}

namespace {

// One for every library that has the template in it: a few.
struct OrderedSolvers {
  std::mutex mutex;
  std::set<VirtualTable> tables;
};

OrderedSolvers& orderedSolvers() {
  static OrderedSolvers solvers;
  return solvers;
}

}  // namespace

bool rememberOrderedSolver(const void* solver) {
  const std::lock_guard lock(orderedSolvers().mutex);
  orderedSolvers().tables.insert(virtualTableOf(solver));
  return true;
}

bool isOrderedSolver(const void* solver) {
  const std::lock_guard lock(orderedSolvers().mutex);
  return orderedSolvers().tables.contains(virtualTableOf(solver));
}

}  // namespace cairn::bullet
